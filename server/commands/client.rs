//! A server of Welkin, as commands talk to it.

use super::Failure;
use futures_util::StreamExt;
use reqwest::{Client, RequestBuilder, Response};
use serde_json::Value;
use std::time::Duration;

/// How long a server may take to take a connection.
const CONNECT_TIMEOUT: Duration = Duration::from_secs(10);

/// Where the server is.
#[derive(clap::Args, Clone, Debug)]
pub(crate) struct ServerFlags {
    /// The server's address
    #[arg(
        long,
        value_name = "URL",
        env = "WELKIN_SERVER",
        default_value = "http://127.0.0.1:8080"
    )]
    server: String,
}

/// A server.
pub(crate) struct Server {
    client: Client,
    address: String,
}

impl Server {
    /// The server that the flags name; nothing is sent yet.
    ///
    /// # Errors
    /// Where there can be no client.
    pub(crate) fn new(flags: &ServerFlags) -> Result<Self, Failure> {
        let client = Client::builder().connect_timeout(CONNECT_TIMEOUT).build();
        Ok(Self {
            client: client.map_err(|e| Failure::Server(e.to_string()))?,
            address: flags.server.trim_end_matches('/').to_owned(),
        })
    }

    /// Sends a job.
    ///
    /// # Errors
    /// Where the server refuses it, or cannot be reached.
    pub(crate) async fn submit(&self, document: String, key: Option<&str>) -> Result<Value, Failure> {
        let request = self
            .client
            .post(self.url("/v1/jobs"))
            .header("content-type", "application/json");
        let request = match key {
            Some(key) => request.header("idempotency-key", key),
            None => request,
        };
        self.json(request.body(document)).await
    }

    /// What a path says.
    ///
    /// # Errors
    /// Where the server refuses, or cannot be reached.
    pub(crate) async fn get(&self, path: &str) -> Result<Value, Failure> {
        self.json(self.client.get(self.url(path))).await
    }

    /// Stops a job.
    ///
    /// # Errors
    /// Where the server refuses, or cannot be reached.
    pub(crate) async fn cancel(&self, id: &str) -> Result<Value, Failure> {
        self.json(self.client.delete(self.url(&format!("/v1/jobs/{id}"))))
            .await
    }

    /// Removes a job with its results.
    ///
    /// # Errors
    /// Where the server refuses, or cannot be reached.
    pub(crate) async fn remove(&self, id: &str) -> Result<(), Failure> {
        let path = format!("/v1/jobs/{id}?results=true");
        self.answer(self.client.delete(self.url(&path))).await.map(drop)
    }

    /// A file, piece by piece.
    ///
    /// # Errors
    /// Where the server refuses, or cannot be reached.
    pub(crate) async fn fetch(
        &self,
        path: &str,
        mut take: impl FnMut(&[u8]) -> std::io::Result<()>,
    ) -> Result<(), Failure> {
        let mut pieces = self.answer(self.client.get(self.url(path))).await?.bytes_stream();
        while let Some(piece) = pieces.next().await {
            let piece = piece.map_err(|e| self.unreached(&e))?;
            take(&piece).map_err(Failure::file("writing a result"))?;
        }
        Ok(())
    }

    fn url(&self, path: &str) -> String {
        format!("{}{path}", self.address)
    }

    async fn json(&self, request: RequestBuilder) -> Result<Value, Failure> {
        let text = self
            .answer(request)
            .await?
            .text()
            .await
            .map_err(|e| self.unreached(&e))?;
        serde_json::from_str(&text)
            .map_err(|e| Failure::Server(format!("{} answered what is not JSON: {e}", self.address)))
    }

    async fn answer(&self, request: RequestBuilder) -> Result<Response, Failure> {
        let answer = request.send().await.map_err(|e| self.unreached(&e))?;
        if answer.status().is_success() {
            return Ok(answer);
        }
        let status = answer.status();
        let problem: Value = answer
            .text()
            .await
            .ok()
            .and_then(|text| serde_json::from_str(&text).ok())
            .unwrap_or_default();
        let detail = problem["detail"].as_str().unwrap_or("no reason was told");
        let place = problem["pointer"]
            .as_str()
            .map(|pointer| format!("{pointer}: "))
            .unwrap_or_default();
        Err(Failure::Server(format!("{place}{detail} ({})", status.as_u16())))
    }

    fn unreached(&self, error: &reqwest::Error) -> Failure {
        let mut reason = error.to_string();
        let mut cause = std::error::Error::source(error);
        while let Some(error) = cause {
            reason = error.to_string();
            cause = error.source();
        }
        Failure::Server(format!("{}: {reason}", self.address))
    }
}
