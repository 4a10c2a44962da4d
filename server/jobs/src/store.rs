//! Where results lie: a folder, or a bucket that speaks S3.

use crate::JobError;
use bytes::Bytes;
use futures_util::{StreamExt, TryStreamExt};
use object_store::{
    ObjectStore, ObjectStoreExt, PutMode, PutOptions, RetryConfig, WriteMultipart, aws::AmazonS3Builder,
    local::LocalFileSystem, path::Path, prefix::PrefixStore,
};
use std::{error::Error as _, fs, io, path::Path as FilePath, sync::Arc, time::Duration};
use tokio::io::AsyncReadExt;

/// A part of a large file that is sent at once, bytes. S3 wants 5 MiB at least.
const PART_BYTES: usize = 8 << 20;

/// A store of results. Clones are the same store.
#[derive(Clone, Debug)]
pub struct Store(Arc<dyn ObjectStore>);

impl Store {
    /// Opens `file:FOLDER`, which is made where it is missing, or `s3://BUCKET/FOLDER`, whose keys and address stand in
    /// the environment as every client of S3 reads them (`AWS_ACCESS_KEY_ID`, `AWS_SECRET_ACCESS_KEY`, `AWS_REGION`,
    /// `AWS_ENDPOINT`, `AWS_ALLOW_HTTP`).
    ///
    /// # Errors
    /// [`JobError::Address`], [`JobError::File`], [`JobError::Store`].
    pub fn open(address: &str) -> Result<Self, JobError> {
        if let Some(folder) = address.strip_prefix("file:") {
            return Self::folder(FilePath::new(folder));
        }
        let Some(place) = address.strip_prefix("s3://") else {
            return Err(JobError::Address(format!(
                "a store of results is file:FOLDER or s3://BUCKET/FOLDER, not {address:?}"
            )));
        };
        let (bucket, folder) = place.split_once('/').unwrap_or((place, ""));
        let retries = RetryConfig {
            // A worker keeps its frame and comes back later itself.
            max_retries: 2,
            retry_timeout: Duration::from_secs(10),
            ..RetryConfig::default()
        };
        let bucket = AmazonS3Builder::from_env()
            .with_bucket_name(bucket)
            .with_retry(retries)
            .build()?;
        Ok(Self::new(Arc::new(PrefixStore::new(bucket, folder))))
    }

    /// A folder, made where it is missing.
    ///
    /// # Errors
    /// Where it cannot be made.
    pub fn folder(folder: &FilePath) -> Result<Self, JobError> {
        let what = || format!("making the folder {} for results", folder.display());
        fs::create_dir_all(folder).map_err(JobError::file(what()))?;
        let store = LocalFileSystem::new_with_prefix(folder)?
            .with_fsync(true)
            .with_automatic_cleanup(true);
        Ok(Self::new(Arc::new(store)))
    }

    /// Any store.
    #[must_use]
    pub fn new(store: Arc<dyn ObjectStore>) -> Self {
        Self(store)
    }

    /// Puts a file where none is. True where it was put, false where one was there already.
    pub(crate) async fn put_new(&self, path: &Path, bytes: Bytes) -> Result<bool, JobError> {
        let mode = PutOptions::from(PutMode::Create);
        match self.0.put_opts(path, bytes.into(), mode).await {
            Ok(_) => Ok(true),
            Err(object_store::Error::AlreadyExists { .. }) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }

    /// Puts a file of this machine, however large; it appears whole, in place of one that was there.
    pub(crate) async fn put_file(&self, path: &Path, file: &FilePath) -> Result<u64, JobError> {
        let reading = || JobError::file(format!("reading {}", file.display()));
        let mut file = tokio::fs::File::open(file).await.map_err(reading())?;
        let mut parts = WriteMultipart::new(self.0.put_multipart(path).await?);
        let (mut buffer, mut sent) = (vec![0; PART_BYTES], 0);
        loop {
            let count = file.read(&mut buffer).await.map_err(reading())?;
            if count == 0 {
                break;
            }
            parts.wait_for_capacity(2).await?;
            parts.write(&buffer[..count]);
            sent += count as u64;
        }
        parts.finish().await?;
        Ok(sent)
    }

    /// A file's bytes; none where there is no such file.
    pub(crate) async fn get(&self, path: &Path) -> Result<Option<Bytes>, JobError> {
        match self.0.get(path).await {
            Ok(found) => Ok(Some(found.bytes().await?)),
            Err(object_store::Error::NotFound { .. }) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// A file as a stream, with its length in bytes; none where there is no such file.
    pub async fn stream(&self, path: &Path) -> Result<Option<(u64, ByteStream)>, JobError> {
        match self.0.get(path).await {
            Ok(found) => {
                let length = found.meta.size;
                let bytes = found.into_stream().map_err(|e| io::Error::other(e.to_string()));
                Ok(Some((length, bytes.boxed())))
            }
            Err(object_store::Error::NotFound { .. }) => Ok(None),
            Err(error) => Err(error.into()),
        }
    }

    /// Files anywhere below a folder, with their lengths in bytes.
    pub(crate) async fn list(&self, folder: &Path) -> Result<Vec<(Path, u64)>, JobError> {
        let found: Vec<_> = self.0.list(Some(folder)).try_collect().await?;
        Ok(found.into_iter().map(|meta| (meta.location, meta.size)).collect())
    }

    /// Removes all files below a folder.
    pub(crate) async fn remove(&self, folder: &Path) -> Result<(), JobError> {
        let found = self.0.list(Some(folder)).map_ok(|meta| meta.location).boxed();
        let removed = self.0.delete_stream(found).filter(|done| {
            // Another process may remove the same.
            let gone = matches!(done, Err(object_store::Error::NotFound { .. }));
            std::future::ready(!gone)
        });
        Ok(removed.try_for_each(|_| std::future::ready(Ok(()))).await?)
    }

    /// Files right inside a folder, with their lengths in bytes.
    pub(crate) async fn list_folder(&self, folder: &Path) -> Result<Vec<(Path, u64)>, JobError> {
        let found = self.0.list_with_delimiter(Some(folder)).await?.objects;
        let mut found: Vec<_> = found.into_iter().map(|meta| (meta.location, meta.size)).collect();
        found.sort();
        Ok(found)
    }
}

/// Bytes on their way.
pub type ByteStream = futures_util::stream::BoxStream<'static, io::Result<Bytes>>;

/// True where trying again soon would not help: the place is full, read-only or not ours.
pub(crate) fn is_lasting(error: &JobError) -> bool {
    let JobError::Store(error) = error else {
        return false;
    };
    if matches!(
        error,
        object_store::Error::PermissionDenied { .. } | object_store::Error::Unauthenticated { .. }
    ) {
        return true;
    }
    let mut cause = error.source();
    while let Some(error) = cause {
        if let Some(error) = error.downcast_ref::<io::Error>() {
            use io::ErrorKind::{PermissionDenied, QuotaExceeded, ReadOnlyFilesystem, StorageFull};
            return matches!(
                error.kind(),
                PermissionDenied | QuotaExceeded | ReadOnlyFilesystem | StorageFull
            );
        }
        cause = error.source();
    }
    false
}
