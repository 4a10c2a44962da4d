//! PostgreSQL and an S3 server of a test's own, on free ports, gone with it.

use std::{
    env, fs,
    io::{Read, Write},
    net::{TcpListener, TcpStream},
    os::unix::{fs::chown, process::CommandExt},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    sync::atomic::{AtomicU16, Ordering},
    time::{Duration, Instant},
};
use tempfile::TempDir;

/// Long enough for a loaded machine; only a hang takes this long.
const PATIENCE: Duration = Duration::from_secs(60);

/// A free port below those that the system gives to whoever calls out: one of these could be taken while its server is
/// down. SeaweedFS also listens ten thousand ports above each.
fn low_port() -> u16 {
    const FIRST: u16 = 12_000;
    const ABOVE: u16 = 10_000;
    static NEXT: AtomicU16 = AtomicU16::new(0);
    let spread = std::process::id() % 500 * 20;
    loop {
        let port = FIRST + (spread as u16 + NEXT.fetch_add(1, Ordering::Relaxed)) % ABOVE;
        let is_free = |port: u16| TcpListener::bind(("127.0.0.1", port)).is_ok();
        if is_free(port) && is_free(port + ABOVE) {
            return port;
        }
    }
}

fn weed() -> Option<PathBuf> {
    if let Some(named) = env::var_os("WEED") {
        return Some(named.into());
    }
    let installed = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/tools/bin/weed");
    let path = env::var_os("PATH").unwrap_or_default();
    let in_path = env::split_paths(&path).map(|folder| folder.join("weed"));
    std::iter::once(installed)
        .chain(in_path)
        .find(|program| program.exists())
}

fn wait_for(port: u16, process: &mut Child, what: &str) {
    let begun = Instant::now();
    while TcpStream::connect(("127.0.0.1", port)).is_err() {
        assert!(process.try_wait().unwrap().is_none(), "{what} ended at once");
        assert!(begun.elapsed() < PATIENCE, "{what} did not come up");
        std::thread::sleep(Duration::from_millis(50));
    }
}

fn silent(command: &mut Command) -> &mut Command {
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
}

/// PostgreSQL with an empty database.
pub(crate) struct Postgres {
    folder: TempDir,
    port: u16,
    process: Option<Child>,
}

impl Postgres {
    pub(crate) fn start() -> Self {
        let folder = TempDir::with_prefix("welkin-postgres-").unwrap();
        let mut postgres = Self {
            port: low_port(),
            process: None,
            folder,
        };
        let own = user().map(|(uid, gid)| chown(postgres.folder.path(), Some(uid), Some(gid)));
        own.unwrap_or(Ok(())).unwrap();
        let data = postgres.data();
        let made = silent(&mut program("initdb"))
            .args(["--auth", "trust", "--username", "welkin", "--no-sync", "--pgdata"])
            .arg(&data)
            .status()
            .unwrap();
        assert!(made.success(), "initdb failed");
        postgres.begin();
        postgres
    }

    fn data(&self) -> PathBuf {
        self.folder.path().join("data")
    }

    fn begin(&mut self) {
        let mut process = silent(&mut program("postgres"))
            .arg("-D")
            .arg(self.data())
            .args(["-p", &self.port.to_string(), "-c", "listen_addresses=127.0.0.1"])
            .arg("-c")
            .arg(format!(
                "unix_socket_directories={}",
                self.folder.path().display()
            ))
            .spawn()
            .unwrap();
        wait_for(self.port, &mut process, "PostgreSQL");
        self.process = Some(process);
    }

    /// Down at once, and up again.
    pub(crate) fn restart(&mut self) {
        let stopped = silent(&mut program("pg_ctl"))
            .args(["stop", "--mode", "immediate", "-D"])
            .arg(self.data())
            .status()
            .unwrap();
        assert!(stopped.success(), "pg_ctl failed");
        self.process.take().unwrap().wait().unwrap();
        self.begin();
    }

    pub(crate) fn address(&self) -> String {
        format!("postgres://welkin@127.0.0.1:{}/postgres", self.port)
    }
}

impl Drop for Postgres {
    fn drop(&mut self) {
        if let Some(mut process) = self.process.take() {
            drop(process.kill());
            drop(process.wait());
        }
    }
}

/// A program of PostgreSQL, as another user where we are root, which it refuses to run as.
fn program(name: &str) -> Command {
    let place = postgres_folder().unwrap_or_else(|| {
        panic!(
            "these tests need PostgreSQL; `scripts/prepare test` installs it, POSTGRES_BIN names its folder"
        )
    });
    let mut command = Command::new(place.join(name));
    if let Some((uid, gid)) = user() {
        command.uid(uid).gid(gid);
    }
    command.current_dir("/");
    command
}

fn postgres_folder() -> Option<PathBuf> {
    if let Some(named) = env::var_os("POSTGRES_BIN") {
        return Some(named.into());
    }
    let versions = fs::read_dir("/usr/lib/postgresql")
        .into_iter()
        .flatten()
        .flatten();
    let debian = versions.map(|version| version.path().join("bin"));
    let path = env::var_os("PATH").unwrap_or_default();
    debian
        .chain(env::split_paths(&path))
        .find(|folder| folder.join("initdb").exists() && folder.join("postgres").exists())
}

/// The user `postgres`, where we are root.
fn user() -> Option<(u32, u32)> {
    let ours = fs::metadata("/proc/self").map(|meta| std::os::unix::fs::MetadataExt::uid(&meta));
    if ours.unwrap_or(1) != 0 {
        return None;
    }
    let users = fs::read_to_string("/etc/passwd").unwrap();
    let line = users.lines().find(|line| line.starts_with("postgres:"));
    let fields: Vec<&str> = line
        .expect("root needs a user `postgres` to run PostgreSQL as")
        .split(':')
        .collect();
    Some((fields[2].parse().unwrap(), fields[3].parse().unwrap()))
}

/// An S3 server with one bucket.
pub(crate) struct S3 {
    folder: TempDir,
    ports: [u16; 4],
    process: Option<Child>,
}

pub(crate) const BUCKET: &str = "welkin";

impl S3 {
    pub(crate) fn start() -> Self {
        let mut s3 = Self {
            folder: TempDir::with_prefix("welkin-s3-").unwrap(),
            ports: std::array::from_fn(|_| low_port()),
            process: None,
        };
        s3.begin();
        s3.make_bucket();
        s3
    }

    pub(crate) fn begin(&mut self) {
        let program = weed().unwrap_or_else(|| {
            panic!("these tests need SeaweedFS; `scripts/prepare test` installs it, WEED names the program")
        });
        let [s3, filer, master, volume] = self.ports;
        let mut process = silent(&mut Command::new(program))
            .args(["server", "-ip=127.0.0.1", "-s3", "-master.volumeSizeLimitMB=64"])
            .arg(format!("-dir={}", self.folder.path().display()))
            .args([
                format!("-s3.port={s3}"),
                format!("-filer.port={filer}"),
                format!("-master.port={master}"),
            ])
            .args([format!("-volume.port={volume}"), "-volume.max=20".into()])
            // Gateways that would listen at the same place whoever starts them.
            .args(["-s3.port.iceberg=0", "-s3.port.lance=0"])
            .spawn()
            .unwrap();
        wait_for(s3, &mut process, "SeaweedFS");
        self.process = Some(process);
    }

    /// The gateway listens before what stands behind it is ready.
    fn make_bucket(&self) {
        let begun = Instant::now();
        loop {
            let mut stream = TcpStream::connect(("127.0.0.1", self.ports[0])).unwrap();
            let head = format!(
                "PUT /{BUCKET} HTTP/1.1\r\nHost: s3\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"
            );
            let mut answer = String::new();
            let asked = stream
                .write_all(head.as_bytes())
                .and_then(|()| stream.read_to_string(&mut answer));
            if asked.is_ok() && answer.starts_with("HTTP/1.1 200") {
                return;
            }
            assert!(begun.elapsed() < PATIENCE, "no bucket: {answer}");
            std::thread::sleep(Duration::from_millis(200));
        }
    }

    /// Down at once.
    pub(crate) fn stop(&mut self) {
        if let Some(mut process) = self.process.take() {
            drop(process.kill());
            drop(process.wait());
        }
    }

    pub(crate) fn endpoint(&self) -> String {
        format!("http://127.0.0.1:{}", self.ports[0])
    }

    /// What clients of S3 read from the environment.
    pub(crate) fn environment(&self) -> [(&'static str, String); 5] {
        [
            ("AWS_ENDPOINT", self.endpoint()),
            ("AWS_ALLOW_HTTP", "true".into()),
            ("AWS_REGION", "us-east-1".into()),
            ("AWS_ACCESS_KEY_ID", "any".into()),
            ("AWS_SECRET_ACCESS_KEY", "any".into()),
        ]
    }
}

impl Drop for S3 {
    fn drop(&mut self) {
        self.stop();
    }
}
