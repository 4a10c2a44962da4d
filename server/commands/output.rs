//! Files that are whole or not there.

use super::{Failure, document::STANDARD};
use std::{
    fs::{self, File},
    io::{self, Write},
    path::{Path, PathBuf},
};

/// Where bytes will go. Opened before the work, so that a place that cannot be written is told at once.
pub(crate) enum Output {
    /// Standard output.
    Standard,
    /// Something that is no ordinary file, such as `/dev/null` or a pipe.
    Special(File, String),
    /// A file, written beside its place and then moved there.
    Whole(Part),
}

/// A file under another name until it is complete; removed where it never is.
pub(crate) struct Part {
    file: File,
    part: PathBuf,
    whole: PathBuf,
    done: bool,
}

impl Output {
    /// Opens a place.
    ///
    /// # Errors
    /// Where it cannot be written.
    pub(crate) fn open(name: &str) -> Result<Self, Failure> {
        if name == STANDARD {
            return Ok(Self::Standard);
        }
        let failed = || Failure::file(format!("writing {name}"));
        // A link stays a link: what it leads to is replaced.
        let whole = fs::canonicalize(name).unwrap_or_else(|_| PathBuf::from(name));
        if whole.metadata().is_ok_and(|meta| !meta.is_file()) {
            let file = File::options().write(true).open(&whole).map_err(failed())?;
            return Ok(Self::Special(file, name.to_owned()));
        }
        let part = beside(&whole);
        let file = File::create_new(&part).map_err(failed())?;
        Ok(Self::Whole(Part {
            file,
            part,
            whole,
            done: false,
        }))
    }

    /// Writes all bytes.
    ///
    /// # Errors
    /// Where they cannot be written; no file is left behind then.
    pub(crate) fn write(self, bytes: &[u8]) -> Result<(), Failure> {
        match self {
            Self::Standard => {
                let mut out = io::stdout().lock();
                let written = out.write_all(bytes).and_then(|()| out.flush());
                written.map_err(Failure::file("writing standard output"))
            }
            Self::Special(mut file, name) => file
                .write_all(bytes)
                .map_err(Failure::file(format!("writing {name}"))),
            Self::Whole(mut part) => part
                .complete(bytes)
                .map_err(Failure::file(format!("writing {}", part.whole.display()))),
        }
    }
}

impl Part {
    fn complete(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.file.write_all(bytes)?;
        self.file.sync_all()?;
        fs::rename(&self.part, &self.whole)?;
        self.done = true;
        Ok(())
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if !self.done {
            // The file is of no use; where it cannot be removed there is nothing else to do.
            let _ = fs::remove_file(&self.part);
        }
    }
}

/// A hidden name in the same folder, so that moving it is one step.
fn beside(whole: &Path) -> PathBuf {
    let name = whole.file_name().unwrap_or_default().to_string_lossy();
    whole.with_file_name(format!(".{name}.{}.part", std::process::id()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("welkin-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn names(folder: &Path) -> Vec<String> {
        fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect()
    }

    #[test]
    fn a_file_appears_whole_and_replaces_the_old() {
        let folder = folder("whole");
        let path = folder.join("sky.png");
        fs::write(&path, "old").unwrap();
        let output = Output::open(path.to_str().unwrap()).unwrap();
        assert_eq!(
            fs::read(&path).unwrap(),
            b"old",
            "untouched until the new one is complete"
        );
        output.write(b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(&folder), ["sky.png"]);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn work_that_fails_leaves_nothing() {
        let folder = folder("nothing");
        drop(Output::open(folder.join("sky.png").to_str().unwrap()).unwrap());
        assert!(names(&folder).is_empty());
        assert!(Output::open(folder.join("no/such/folder/sky.png").to_str().unwrap()).is_err());
        assert!(
            Output::open(folder.to_str().unwrap()).is_err(),
            "a folder is not a file"
        );
        fs::remove_dir_all(folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_written_and_not_replaced() {
        Output::open("/dev/null").unwrap().write(b"gone").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}
