//! Every command in the documentation runs, against a server of its own.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "tests fail by panicking")]

use std::{
    fs,
    net::{TcpListener, TcpStream},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};

const WELKIN: &str = env!("CARGO_BIN_EXE_welkin");
/// The address that the documentation names.
const WRITTEN: &str = "http://127.0.0.1:8080";

struct Server {
    process: Child,
    address: String,
}

/// A folder that is nobody's.
fn assets() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("docs-assets")
}

impl Server {
    fn start() -> Self {
        let address = TcpListener::bind("127.0.0.1:0")
            .unwrap()
            .local_addr()
            .unwrap()
            .to_string();
        let process = Command::new(WELKIN)
            .args(["serve", "--listen", &address])
            .env("WELKIN_ASSETS", assets())
            .env(
                "WELKIN_QUEUE",
                format!("sqlite:{}", assets().join("jobs.db").display()),
            )
            .env(
                "WELKIN_STORE",
                format!("file:{}", assets().join("results").display()),
            )
            .spawn()
            .unwrap();
        let mut server = Self { process, address };
        let begun = Instant::now();
        while TcpStream::connect(&server.address).is_err() {
            assert!(server.process.try_wait().unwrap().is_none(), "the server ended");
            assert!(
                begun.elapsed() < Duration::from_secs(120),
                "the server did not come up"
            );
            std::thread::sleep(Duration::from_millis(100));
        }
        server
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        drop(self.process.kill());
        drop(self.process.wait());
    }
}

/// The blocks marked `sh` of one page.
fn blocks(page: &str) -> Vec<String> {
    page.split("```sh\n")
        .skip(1)
        .map(|rest| rest.split("```").next().unwrap().to_owned())
        .collect()
}

fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let docs = fs::read_dir(root.join("docs"))
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut pages: Vec<PathBuf> = docs
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .collect();
    pages.push(root.join("README.md"));
    pages
}

/// `make` is what runs this test; the benches take minutes and have a test of their own, `tests/bench.rs`.
fn runs_elsewhere(block: &str) -> bool {
    let commands = block
        .lines()
        .filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
    commands
        .into_iter()
        .all(|line| line.starts_with("make ") || line.starts_with("welkin bench "))
}

#[test]
fn every_command_in_the_documentation_runs() {
    let server = Server::start();
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("docs");
    drop(fs::remove_dir_all(&folder));
    fs::create_dir_all(&folder).unwrap();
    // Who reads the documentation stands in the repository.
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    std::os::unix::fs::symlink(tests, folder.join("tests")).unwrap();
    // So that curl fails where the server refuses.
    fs::write(folder.join(".curlrc"), "fail-with-body\n").unwrap();
    let path = format!(
        "{}:{}",
        Path::new(WELKIN).parent().unwrap().display(),
        std::env::var("PATH").unwrap()
    );
    let mut ran = 0;
    for page in pages() {
        for block in blocks(&fs::read_to_string(&page).unwrap()) {
            if runs_elsewhere(&block) {
                continue;
            }
            let script = block.replace(WRITTEN, &format!("http://{}", server.address));
            let output = Command::new("bash")
                .args(["-euo", "pipefail", "-c", &script])
                .current_dir(&folder)
                .env("PATH", &path)
                .env("CURL_HOME", &folder)
                .env("WELKIN_ASSETS", assets())
                .stdin(Stdio::null())
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&output.stdout);
            let wrong = String::from_utf8_lossy(&output.stderr);
            assert!(
                output.status.success(),
                "{}:\n{block}\n{said}\n{wrong}",
                page.display()
            );
            ran += 1;
        }
    }
    assert!(ran >= 3, "only {ran} blocks were found");
    let begins = |name: &str, magic: &[u8]| {
        let bytes = fs::read(folder.join(name)).unwrap();
        assert!(bytes.starts_with(magic), "{name} is not what its name says");
    };
    for name in ["sunset.jpg", "storm.jpg", "layers.jpg", "front.jpg", "moment.jpg"] {
        begins(name, &[0xff, 0xd8, 0xff]);
    }
    begins("madrid.exr", &[0x76, 0x2f, 0x31, 0x01]);
    begins("sky.exr", &[0x76, 0x2f, 0x31, 0x01]);
    begins("orbit.png", b"\x89PNG");
}
