//! Jobs through the program itself: a server that is killed, workers beside it, the commands.
#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use serde_json::{Value, json};
use std::sync::{Arc, Mutex};
use std::{
    fs,
    io::{BufRead, BufReader, Read, Write},
    net::{TcpListener, TcpStream},
    path::Path,
    process::{Child, Command, Output, Stdio},
    time::{Duration, Instant},
};
use tempfile::TempDir;

const WELKIN: &str = env!("CARGO_BIN_EXE_welkin");
/// Long enough for a loaded machine that compiles its shaders; only a hang takes this long.
const PATIENCE: Duration = Duration::from_secs(180);

struct Place {
    folder: TempDir,
    address: String,
}

/// A process that ends with the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        drop(self.0.kill());
        drop(self.0.wait());
    }
}

impl Place {
    fn new() -> Self {
        let port = TcpListener::bind("127.0.0.1:0")
            .unwrap()
            .local_addr()
            .unwrap()
            .port();
        Self {
            folder: TempDir::new().unwrap(),
            address: format!("127.0.0.1:{port}"),
        }
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).display().to_string()
    }

    fn welkin(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(WELKIN);
        command
            .args(arguments)
            .env("WELKIN_QUEUE", format!("sqlite:{}", self.path("jobs.db")))
            .env("WELKIN_STORE", format!("file:{}", self.path("results")))
            .env("WELKIN_ASSETS", self.path("assets"))
            .env("WELKIN_SERVER", format!("http://{}", self.address))
            .env("WELKIN_HEARTBEAT_S", "1")
            .env("WELKIN_LOG", "warn")
            .stdin(Stdio::null());
        command
    }

    fn serve(&self, more: &[&str]) -> Running {
        let mut arguments = vec!["serve", "--listen", &self.address];
        arguments.extend(more);
        let mut server = Running(self.welkin(&arguments).spawn().unwrap());
        let begun = Instant::now();
        while TcpStream::connect(&self.address).is_err() {
            assert!(server.0.try_wait().unwrap().is_none(), "the server ended");
            assert!(begun.elapsed() < PATIENCE, "the server did not come up");
            std::thread::sleep(Duration::from_millis(50));
        }
        server
    }

    fn submit(&self, document: &Value, more: &[&str]) -> Output {
        let file = self.path("job.json");
        fs::write(&file, document.to_string()).unwrap();
        let mut arguments = vec!["submit", file.as_str()];
        arguments.extend(more);
        self.welkin(&arguments).output().unwrap()
    }

    fn job(&self, id: &str) -> Value {
        let output = self.welkin(&["jobs", id, "--json"]).output().unwrap();
        serde_json::from_slice(&output.stdout).unwrap_or_default()
    }

    fn until(&self, id: &str, far: impl Fn(&Value) -> bool) -> Value {
        let begun = Instant::now();
        loop {
            let job = self.job(id);
            if far(&job) {
                return job;
            }
            assert!(begun.elapsed() < PATIENCE, "{job:#}");
            std::thread::sleep(Duration::from_millis(100));
        }
    }
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).trim().to_owned()
}

fn small(count: u32) -> Value {
    json!({"frames": {"kind": "random", "count": count, "scene": {"clouds": null}, "ranges": [
        {"field": "/sun/position/elevation_deg", "from": -5, "to": 60}]}, "width_px": 16, "height_px": 16})
}

/// The bytes of a frame as the server makes it for one who asks for it alone.
fn alone(place: &Place, scene: &Value) -> Vec<u8> {
    let request = json!({"scene": scene, "width_px": 16, "height_px": 16, "format": "png"});
    let answer = Command::new("curl")
        .args(["--silent", "--fail", "--json", &request.to_string()])
        .arg(format!("http://{}/v1/frames", place.address))
        .output()
        .unwrap();
    assert!(answer.status.success());
    answer.stdout
}

#[test]
fn a_batch_survives_its_server_and_is_what_frames_are() {
    let place = Place::new();
    let server = place.serve(&[]);
    let sent = place.submit(&small(60), &["--key", "mine"]);
    assert!(sent.status.success(), "{}", text(&sent.stderr));
    let id = text(&sent.stdout);
    place.until(&id, |job| job["counts"]["done"].as_u64() > Some(3));
    // kill -9
    drop(server);

    let _server = place.serve(&[]);
    let again = place.submit(&small(60), &["--key", "mine", "--wait"]);
    assert!(again.status.success(), "{}", text(&again.stderr));
    assert!(
        text(&again.stdout).starts_with(&id),
        "the key stands for the first job"
    );
    let job = place.job(&id);
    assert_eq!(
        (&job["state"], &job["counts"]["done"]),
        (&json!("done"), &json!(60)),
        "{job:#}"
    );

    let folder = place.path("fetched");
    let fetched = place
        .welkin(&["jobs", &id, "--output", &folder])
        .output()
        .unwrap();
    assert!(fetched.status.success(), "{}", text(&fetched.stderr));
    let labels = fs::read_to_string(Path::new(&folder).join("labels.jsonl")).unwrap();
    assert_eq!(labels.lines().count(), 60);
    for line in labels.lines().step_by(13) {
        let label: Value = serde_json::from_str(line).unwrap();
        let name = format!("{:06}.png", label["frame"].as_u64().unwrap());
        let frame = fs::read(Path::new(&folder).join(&name)).unwrap();
        assert!(
            frame == alone(&place, &label["scene"]),
            "{name} is not what the frame is alone"
        );
    }
}

#[test]
fn workers_take_what_the_server_leaves_to_them() {
    let place = Place::new();
    let _server = place.serve(&["--job-frames", "0"]);
    let sent = place.submit(&small(12), &[]);
    let id = text(&sent.stdout);
    assert_eq!(place.job(&id)["counts"]["waiting"], 12);
    let address = format!(
        "127.0.0.1:{}",
        TcpListener::bind("127.0.0.1:0")
            .unwrap()
            .local_addr()
            .unwrap()
            .port()
    );
    let workers: Vec<_> = [vec!["worker", "--metrics", &address], vec!["worker"]]
        .iter()
        .map(|arguments| Running(place.welkin(arguments).stderr(Stdio::null()).spawn().unwrap()))
        .collect();
    let job = place.until(&id, |job| !job["ended_at"].is_null());
    assert_eq!(
        (&job["state"], &job["counts"]["done"]),
        (&json!("done"), &json!(12)),
        "{job:#}"
    );
    let numbers = Command::new("curl")
        .args(["--silent", &format!("http://{address}/metrics")])
        .output()
        .unwrap();
    let numbers = text(&numbers.stdout);
    for name in [
        "welkin_job_frames_total",
        "welkin_job_wait_seconds",
        "welkin_job_stage_seconds",
        "welkin_render_pass_seconds",
    ] {
        assert!(numbers.contains(name), "{name}: {numbers}");
    }
    drop(workers);
}

#[test]
fn a_stopped_job_lets_go_of_the_device_within_two_seconds() {
    let place = Place::new();
    let _server = place.serve(&[]);
    // Cloudy and large: a frame takes minutes where two cores render in software, a tile a fraction of a second.
    let mut slow = small(4);
    slow["frames"]["scene"] = json!({});
    (slow["width_px"], slow["height_px"]) = (json!(2560), json!(1440));
    let id = text(&place.submit(&slow, &[]).stdout);
    place.until(&id, |job| job["counts"]["running"].as_u64() > Some(0));
    // In the middle of the first frame.
    std::thread::sleep(Duration::from_secs(3));
    let begun = Instant::now();
    let stopped = place.welkin(&["jobs", &id, "--cancel"]).output().unwrap();
    assert!(stopped.status.success(), "{}", text(&stopped.stderr));
    let job = place.until(&id, |job| job["counts"]["running"] == 0);
    // The promise of the product.
    assert!(begun.elapsed() < Duration::from_secs(2), "{:?}", begun.elapsed());
    assert_eq!(
        (&job["state"], &job["counts"]["done"]),
        (&json!("cancelled"), &json!(0)),
        "{job:#}"
    );
    let frames = Path::new(&place.path("results")).join(format!("jobs/{id}/frames"));
    assert!(!frames.exists() || fs::read_dir(frames).unwrap().next().is_none());
    // The device is free: what comes next is rendered at once, not after the frames that nobody wants.
    let begun = Instant::now();
    let next = place.submit(&small(1), &["--wait"]);
    assert!(next.status.success(), "{}", text(&next.stderr));
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
}

#[test]
fn what_the_server_would_refuse_is_told_with_its_place() {
    let place = Place::new();
    let wrong = place.submit(&json!({"frames": {"kind": "list", "scenes": [{"sun": 1}]}}), &[]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(
        text(&wrong.stderr).contains("/frames/scenes/0/sun"),
        "{}",
        text(&wrong.stderr)
    );
    let nobody = place.submit(&small(1), &[]);
    assert_eq!(nobody.status.code(), Some(1));
    assert!(
        text(&nobody.stderr).contains(&place.address),
        "{}",
        text(&nobody.stderr)
    );
}

/// First lines and bodies of requests.
type Taken = Arc<Mutex<Vec<(String, Vec<u8>)>>>;

/// A collector of OpenTelemetry that takes what it is sent, and its address.
fn collector() -> (String, Taken) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = format!("http://{}", listener.local_addr().unwrap());
    let taken = Taken::default();
    let into = Arc::clone(&taken);
    std::thread::spawn(move || {
        for stream in listener.incoming() {
            let mut stream = BufReader::new(stream.unwrap());
            let (mut first, mut length) = (String::new(), 0);
            stream.read_line(&mut first).unwrap();
            loop {
                let mut line = String::new();
                if stream.read_line(&mut line).unwrap() == 0 || line == "\r\n" {
                    break;
                }
                if let Some(value) = line.to_ascii_lowercase().strip_prefix("content-length:") {
                    length = value.trim().parse().unwrap();
                }
            }
            let mut body = vec![0; length];
            stream.read_exact(&mut body).unwrap();
            let answer = "HTTP/1.1 200 OK\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
            stream.get_mut().write_all(answer.as_bytes()).unwrap();
            into.lock().unwrap().push((first, body));
        }
    });
    (address, taken)
}

#[cfg(target_os = "linux")]
#[test]
fn a_collector_is_told_of_frames_and_of_their_stages() {
    let place = Place::new();
    let (address, taken) = collector();
    let mut server = place.serve(&["--otlp", &address, "--log", "info"]);
    let sent = place.submit(&small(2), &["--wait"]);
    assert!(sent.status.success(), "{}", text(&sent.stderr));
    // The last spans are sent when the program ends as it should.
    let stopped = Command::new("kill")
        .arg(server.0.id().to_string())
        .status()
        .unwrap();
    assert!(stopped.success() && server.0.wait().unwrap().success());
    let taken = taken.lock().unwrap();
    assert!(
        taken.iter().all(|(line, _)| line.starts_with("POST /v1/traces ")),
        "{taken:?}"
    );
    let told: Vec<u8> = taken.iter().flat_map(|(_, body)| body.clone()).collect();
    let told = String::from_utf8_lossy(&told);
    for name in [
        "welkin",
        "service.version",
        "task",
        "render",
        "encode",
        "store",
        "/v1/jobs",
        &text(&sent.stdout)[..26],
    ] {
        assert!(told.contains(name), "{name}");
    }
    let wrong = place.welkin(&["serve", "--otlp", "collector"]).output().unwrap();
    assert_eq!(wrong.status.code(), Some(2), "{}", text(&wrong.stderr));
}
