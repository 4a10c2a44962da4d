//! Films of a job's frames: APNG and GIF by ourselves, MP4 and WebM by ffmpeg.

use crate::JobError;
use gif::{Encoder as GifEncoder, Repeat};
use png::{BitDepth, ColorType, Compression};
use std::{
    fs::File,
    io::{self, BufWriter, Read, Write},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
};
use welkin_scene::{Format, job::Film};

/// Speed of the choice of a GIF's colours, 1 to 30: at 10 a 720p frame takes a fifth of a second.
const GIF_SPEED: i32 = 10;
/// Where `ffmpeg` is, when it is not in the path.
const FFMPEG: &str = "FFMPEG";

/// A film that is being made.
pub(crate) struct Making {
    pub(crate) film: Film,
    pub(crate) file: PathBuf,
    writer: Writer,
}

/// One kind of film.
enum Writer {
    Apng(Box<png::Writer<BufWriter<File>>>),
    Gif(Box<GifEncoder<BufWriter<File>>>, GifClock),
    Ffmpeg(Process, PathBuf),
}

/// A process that ends with who started it.
struct Process(Child);

impl Drop for Process {
    fn drop(&mut self) {
        // Of one that has ended already there is nothing to end.
        drop(self.0.kill());
        drop(self.0.wait());
    }
}

/// What frames have in common.
#[derive(Clone, Copy)]
pub(crate) struct Shape {
    pub(crate) width_px: u32,
    pub(crate) height_px: u32,
    pub(crate) frames: u32,
    pub(crate) fps: u32,
    pub(crate) format: Format,
}

/// GIF counts hundredths of a second, so that delays alternate where a frame does not take a whole number of them.
#[derive(Default)]
struct GifClock {
    frame: u32,
}

impl GifClock {
    fn delay_cs(&mut self, fps: u32) -> u16 {
        let at = |frame: u32| u64::from(frame) * 100 / u64::from(fps);
        let delay = at(self.frame + 1) - at(self.frame);
        self.frame += 1;
        u16::try_from(delay).unwrap_or(u16::MAX)
    }
}

impl Making {
    /// Begins a film in a folder; none where it needs ffmpeg and there is none.
    pub(crate) fn begin(film: Film, folder: &Path, shape: Shape) -> Result<Option<Self>, JobError> {
        let file = folder.join(format!("film.{}", film.extension()));
        let create = || Ok::<_, JobError>(BufWriter::new(File::create(&file).map_err(writing())?));
        let writer = match film {
            Film::Apng => Writer::Apng(Box::new(apng(create()?, shape)?)),
            Film::Gif => {
                let side = |px: u32| u16::try_from(px).unwrap_or(u16::MAX);
                let mut gif = GifEncoder::new(create()?, side(shape.width_px), side(shape.height_px), &[])
                    .map_err(damaged)?;
                gif.set_repeat(Repeat::Infinite).map_err(damaged)?;
                Writer::Gif(Box::new(gif), GifClock::default())
            }
            Film::Mp4 | Film::Webm => {
                let log = folder.join(format!("{}.log", film.extension()));
                match ffmpeg(film, &file, &log, shape) {
                    Ok(child) => Writer::Ffmpeg(Process(child), log),
                    Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
                    Err(error) => return Err(JobError::file("starting ffmpeg")(error)),
                }
            }
        };
        Ok(Some(Self { film, file, writer }))
    }

    /// Adds a frame, given as its file and as R G B of its pixels.
    pub(crate) fn add(&mut self, file: &[u8], rgb: &[u8], shape: Shape) -> Result<(), JobError> {
        match &mut self.writer {
            Writer::Apng(apng) => apng.write_image_data(rgb).map_err(damaged),
            Writer::Gif(gif, clock) => {
                let side = |px: u32| u16::try_from(px).unwrap_or(u16::MAX);
                let mut frame =
                    gif::Frame::from_rgb_speed(side(shape.width_px), side(shape.height_px), rgb, GIF_SPEED);
                frame.delay = clock.delay_cs(shape.fps);
                gif.write_frame(&frame).map_err(damaged)
            }
            Writer::Ffmpeg(Process(child), log) => {
                let Some(pipe) = &mut child.stdin else {
                    return Err(JobError::Damaged("ffmpeg has no input".into()));
                };
                pipe.write_all(file)
                    .map_err(|error| JobError::Damaged(format!("ffmpeg: {error}; {}", said(log))))
            }
        }
    }

    /// Ends the film; its file is whole then.
    pub(crate) fn finish(self) -> Result<(Film, PathBuf), JobError> {
        match self.writer {
            Writer::Apng(apng) => apng.finish().map_err(damaged)?,
            Writer::Gif(gif, _) => gif.into_inner().map_err(damaged)?.flush().map_err(writing())?,
            Writer::Ffmpeg(mut process, log) => {
                drop(process.0.stdin.take());
                let status = process.0.wait().map_err(JobError::file("waiting for ffmpeg"))?;
                if !status.success() {
                    return Err(JobError::Damaged(format!("ffmpeg: {status}; {}", said(&log))));
                }
            }
        }
        Ok((self.film, self.file))
    }
}

fn apng(file: BufWriter<File>, shape: Shape) -> Result<png::Writer<BufWriter<File>>, JobError> {
    let mut encoder = png::Encoder::new(file, shape.width_px, shape.height_px);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_animated(shape.frames, 0).map_err(damaged)?;
    let fps = u16::try_from(shape.fps).unwrap_or(u16::MAX);
    encoder.set_frame_delay(1, fps).map_err(damaged)?;
    encoder.write_header().map_err(damaged)
}

fn ffmpeg(film: Film, file: &Path, log: &Path, shape: Shape) -> io::Result<Child> {
    let program = std::env::var(FFMPEG).unwrap_or_else(|_| "ffmpeg".into());
    let input = if shape.format == Format::Jpeg {
        "mjpeg"
    } else {
        "png"
    };
    // Colours are halved in number each way, so sides must be even; the matrix is that of high definition, and is told.
    let filter = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv";
    let codec: &[&str] = match film {
        Film::Webm => &["-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1"],
        _ => &["-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"],
    };
    Command::new(program)
        .args([
            "-nostdin",
            "-loglevel",
            "error",
            "-y",
            "-f",
            "image2pipe",
            "-c:v",
            input,
            "-framerate",
        ])
        .arg(shape.fps.to_string())
        .args(["-i", "pipe:0", "-vf", filter, "-pix_fmt", "yuv420p"])
        .args([
            "-colorspace",
            "bt709",
            "-color_primaries",
            "bt709",
            "-color_trc",
            "iec61966-2-1",
        ])
        .args(codec)
        .arg(file)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(File::create(log)?)
        .spawn()
}

/// The end of what ffmpeg said.
fn said(log: &Path) -> String {
    let mut text = String::new();
    let read = File::open(log).and_then(|mut file| file.read_to_string(&mut text));
    let lines: Vec<_> = text.lines().rev().take(3).collect();
    match read {
        Ok(_) => lines.into_iter().rev().collect::<Vec<_>>().join("; "),
        Err(error) => error.to_string(),
    }
}

/// R G B of each pixel of a frame's file.
pub(crate) fn decoded(file: &[u8], format: Format) -> Result<Vec<u8>, JobError> {
    if format == Format::Jpeg {
        return jpeg_decoder::Decoder::new(file).decode().map_err(damaged);
    }
    let mut reader = png::Decoder::new(io::Cursor::new(file))
        .read_info()
        .map_err(damaged)?;
    let size = reader.output_buffer_size().unwrap_or_default();
    let mut rgb = vec![0; size];
    let info = reader.next_frame(&mut rgb).map_err(damaged)?;
    rgb.truncate(info.buffer_size());
    Ok(rgb)
}

fn damaged(error: impl std::fmt::Display) -> JobError {
    JobError::Damaged(format!("a film: {error}"))
}

fn writing() -> impl FnOnce(io::Error) -> JobError {
    JobError::file("writing a film")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gif_lasts_as_long_as_its_frames() {
        for fps in [1, 7, 24, 30, 60, 100, 120] {
            let mut clock = GifClock::default();
            let all: u64 = (0..fps * 10).map(|_| u64::from(clock.delay_cs(fps))).sum();
            assert_eq!(all, 1000, "{fps}");
        }
    }
}
