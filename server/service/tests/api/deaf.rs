//! A viewer by hand.

use tokio::{
    io::{AsyncReadExt, AsyncWriteExt},
    net::TcpStream,
};

pub(crate) const BINARY: u8 = 2;
pub(crate) const CLOSE: u8 = 8;
pub(crate) const PING: u8 = 9;
pub(crate) const PONG: u8 = 10;

/// A viewer that answers no ping: only what is written by hand goes out.
pub(crate) struct Deaf(TcpStream);

impl Deaf {
    pub(crate) async fn connect(address: std::net::SocketAddr) -> Self {
        let mut stream = TcpStream::connect(address).await.unwrap();
        let request = "GET /v1/live HTTP/1.1\r\nHost: welkin\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n\
                       Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
        stream.write_all(request.as_bytes()).await.unwrap();
        let mut head = Vec::new();
        while !head.ends_with(b"\r\n\r\n") {
            head.push(stream.read_u8().await.unwrap());
        }
        assert!(head.starts_with(b"HTTP/1.1 101"));
        Self(stream)
    }

    /// A client's frame is masked (RFC 6455 §5.3); a mask of zeros leaves the data as it is.
    pub(crate) async fn send(&mut self, opcode: u8, data: &[u8]) {
        assert!(data.len() < 126);
        let mut frame = vec![0x80 | opcode, 0x80 | data.len() as u8, 0, 0, 0, 0];
        frame.extend(data);
        self.0.write_all(&frame).await.unwrap();
    }

    /// Opcode and data of the next frame.
    pub(crate) async fn read(&mut self) -> (u8, Vec<u8>) {
        let opcode = self.0.read_u8().await.unwrap() & 0x0f;
        let length = match self.0.read_u8().await.unwrap() {
            126 => self.0.read_u16().await.unwrap().into(),
            127 => self.0.read_u64().await.unwrap() as usize,
            short => usize::from(short),
        };
        let mut data = vec![0; length];
        self.0.read_exact(&mut data).await.unwrap();
        (opcode, data)
    }
}
