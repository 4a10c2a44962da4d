//! The order in which the pixels of a frame are refined.

/// Passes after which every pixel is final.
pub const PASSES: u16 = 16;
/// Pixels between those of one pass, across and down.
pub const STRIDE: u32 = 4;

/// The pass that each pixel of a square of [`STRIDE`] belongs to, less one, rows from the top: Bayer's order (1973), in
/// which those of every few passes lie as evenly as they can.
const BAYER: [[u16; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// The pass that computes a pixel, from 1.
#[must_use]
pub const fn pass_of(x: u32, y: u32) -> u16 {
    BAYER[(y % STRIDE) as usize][(x % STRIDE) as usize] + 1
}

/// The first pixel of a pass, from 1 to [`PASSES`]: column and row. The others follow [`STRIDE`] apart.
#[must_use]
pub fn first_of(pass: u16) -> [u32; 2] {
    let all = (0..STRIDE).flat_map(|y| (0..STRIDE).map(move |x| [x, y]));
    let mut of_pass = all.filter(|[x, y]| pass_of(*x, *y) == pass);
    of_pass.next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pass_has_one_pixel_of_a_square() {
        for pass in 1..=PASSES {
            let [x, y] = first_of(pass);
            assert_eq!(pass_of(x, y), pass);
            assert_eq!(pass_of(x + 7 * STRIDE, y + 5 * STRIDE), pass);
        }
    }

    /// After 1, 4 and 16 passes the pixels stand on a square lattice of 4, 2 and 1.
    #[test]
    fn lattices_fill_evenly() {
        for (passes, apart) in [(1, 4), (4, 2), (16, 1)] {
            for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))) {
                assert_eq!(
                    pass_of(x, y) <= passes,
                    x % apart == 0 && y % apart == 0,
                    "{passes} passes, {x} {y}"
                );
            }
        }
    }
}
