//! The 16 bytes before each picture.

use super::view::LiveFormat;

/// Length of the header, bytes.
pub(crate) const LENGTH: usize = 16;

/// What the bytes say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Header {
    /// The last message that the picture obeys.
    pub(crate) seq: u32,
    /// 0 for the preview, 1 for its refinement.
    pub(crate) pass: u16,
    /// How many passes there will be if nothing changes.
    pub(crate) passes: u16,
    pub(crate) width_px: u16,
    pub(crate) height_px: u16,
    pub(crate) format: LiveFormat,
}

impl Header {
    /// Little-endian, without gaps but the three zero bytes at the end.
    pub(crate) fn bytes(self) -> [u8; LENGTH] {
        let mut bytes = [0; LENGTH];
        bytes[0..4].copy_from_slice(&self.seq.to_le_bytes());
        bytes[4..6].copy_from_slice(&self.pass.to_le_bytes());
        bytes[6..8].copy_from_slice(&self.passes.to_le_bytes());
        bytes[8..10].copy_from_slice(&self.width_px.to_le_bytes());
        bytes[10..12].copy_from_slice(&self.height_px.to_le_bytes());
        bytes[12] = match self.format {
            LiveFormat::Jpeg => 1,
            LiveFormat::Png => 2,
            LiveFormat::Raw => 3,
        };
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_byte_has_its_place() {
        let header = Header {
            seq: 0x0403_0201,
            pass: 0x0605,
            passes: 0x0807,
            width_px: 0x0a09,
            height_px: 0x0c0b,
            format: LiveFormat::Raw,
        };
        assert_eq!(
            header.bytes(),
            [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 3, 0, 0, 0]
        );
        assert_eq!(
            Header {
                format: LiveFormat::Jpeg,
                ..header
            }
            .bytes()[12],
            1
        );
        assert_eq!(
            Header {
                format: LiveFormat::Png,
                ..header
            }
            .bytes()[12],
            2
        );
    }
}
