//! Noise to bytes: how its values are spread over 0..1.

/// Four values a texel, as the noise shaders leave them.
type Texels = [[f32; 4]];

/// A share of the values that may be cut off at either end when they are stretched.
const CUT_SHARE: f64 = 1e-3;

/// From 0..1 to the nearest byte.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to 0..255 first"
)]
fn byte(value: f32) -> u8 {
    (255.0 * value + 0.5).clamp(0.0, 255.0) as u8
}

/// By rank: each byte stands for as many texels as any other. Texels of one value are told apart by their place.
pub(crate) fn even(texels: &Texels, channel: usize) -> Vec<u8> {
    // Floats in the order of their bits once the sign is seen to, each with its place behind.
    let in_order = |(place, texel): (u32, &[f32; 4])| {
        let bits = texel[channel].to_bits();
        let ordered = if bits >> 31 == 0 { bits | 1 << 31 } else { !bits };
        u64::from(ordered) << 32 | u64::from(place)
    };
    let mut ranked: Vec<u64> = (0..).zip(texels).map(in_order).collect();
    ranked.sort_unstable();
    let count = ranked.len().max(1);
    let mut bytes = vec![0; texels.len()];
    for (rank, key) in ranked.into_iter().enumerate() {
        let place = usize::try_from(key & u64::from(u32::MAX)).unwrap_or(0);
        bytes[place] = u8::try_from(256 * rank / count).unwrap_or(u8::MAX);
    }
    bytes
}

/// In proportion, so that all but the outermost values fill 0..1.
pub(crate) fn stretched(texels: &Texels, channel: usize) -> Vec<u8> {
    let mut values: Vec<f32> = texels.iter().map(|texel| texel[channel]).collect();
    let last = values.len().saturating_sub(1);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a thousandth of some millions"
    )]
    let cut = (last as f64 * CUT_SHARE) as usize;
    let low = *values.select_nth_unstable_by(cut, f32::total_cmp).1;
    let high = *values.select_nth_unstable_by(last - cut, f32::total_cmp).1;
    let scale = 1.0 / (high - low).max(f32::MIN_POSITIVE);
    texels
        .iter()
        .map(|texel| byte((texel[channel] - low) * scale))
        .collect()
}

/// All channels in the same proportion about 0.5, so that the largest value of either sign reaches 0 or 1.
pub(crate) fn around_the_middle(texels: &Texels) -> Vec<u8> {
    let largest = texels
        .iter()
        .flatten()
        .fold(f32::MIN_POSITIVE, |a, v| a.max(v.abs()));
    let scale = 0.5 / largest;
    texels.iter().flatten().map(|v| byte(0.5 + scale * v)).collect()
}

/// Four channels as texels.
pub(crate) fn interleaved([r, g, b, a]: [Vec<u8>; 4]) -> Vec<u8> {
    let texels = r.into_iter().zip(g).zip(b).zip(a);
    texels.flat_map(|(((r, g), b), a)| [r, g, b, a]).collect()
}
