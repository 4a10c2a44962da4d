//! The near side of the moon: its dark plains and bright craters, by their places in the IAU's gazetteer.
//!
//! Libration is left out, so that one picture serves: x east (right as seen from the northern hemisphere), y north, seen
//! from afar. Values are albedo over that of the whole disc.

use glam::{DVec2, DVec3};
use std::sync::LazyLock;

/// Texels along each side of the picture of the disc.
pub(crate) const SIDE: usize = 512;
/// A degree of the moon's surface, kilometres.
const KM_PER_DEG: f64 = 30.323;

/// North latitude and east longitude, degrees, and diameter, km. Long plains are chains of circles.
type Place = (f64, f64, f64);

const MARIA: [Place; 41] = [
    (32.8, -15.6, 1146.0), // Mare Imbrium
    (28.0, 17.5, 674.0),   // Mare Serenitatis
    (8.5, 31.4, 830.0),    // Mare Tranquillitatis
    (17.0, 59.1, 470.0),   // Mare Crisium
    (-3.0, 51.0, 560.0),   // Mare Fecunditatis, north
    (-13.0, 51.5, 480.0),  // Mare Fecunditatis, south
    (-15.2, 35.5, 340.0),  // Mare Nectaris
    (-21.3, -16.6, 640.0), // Mare Nubium
    (-24.4, -38.6, 420.0), // Mare Humorum
    (-10.0, -23.1, 350.0), // Mare Cognitum
    (13.3, 3.6, 230.0),    // Mare Vaporum
    (7.5, -30.9, 480.0),   // Mare Insularum
    (18.4, -57.4, 900.0),  // Oceanus Procellarum
    (35.0, -55.0, 620.0),  // Oceanus Procellarum, north
    (2.0, -50.0, 780.0),   // Oceanus Procellarum, south
    (-8.0, -45.0, 520.0),  // Oceanus Procellarum, towards Humorum
    (12.1, -8.3, 280.0),   // Sinus Aestuum
    (1.6, 1.0, 250.0),     // Sinus Medii
    (45.0, -31.7, 249.0),  // Sinus Iridum
    (50.3, -50.9, 300.0),  // Sinus Roris
    (54.0, -38.0, 260.0),  // Mare Frigoris, from west to east
    (56.0, -26.0, 230.0),
    (57.5, -13.0, 220.0),
    (58.0, 1.0, 220.0),
    (57.0, 14.0, 230.0),
    (54.0, 26.0, 260.0),
    (51.0, 36.0, 230.0),
    (37.6, 30.8, 330.0),   // Lacus Somniorum
    (45.0, 27.2, 200.0),   // Lacus Mortis
    (-32.0, -28.2, 220.0), // Palus Epidemiarum
    (26.4, 0.4, 160.0),    // Palus Putredinis
    (1.3, 65.3, 139.0),    // Mare Spumans
    (7.5, 68.7, 245.0),    // Mare Undarum
    (-1.7, 87.1, 374.0),   // Mare Smythii
    (12.7, 86.5, 358.0),   // Mare Marginis
    (56.9, 81.5, 231.0),   // Mare Humboldtianum
    (-45.0, 88.0, 560.0),  // Mare Australe
    (-5.4, -68.4, 173.0),  // Grimaldi
    (51.6, -9.4, 101.0),   // Plato
    (-19.0, -89.0, 300.0), // Mare Orientale
    (21.0, 38.0, 150.0),   // Sinus Amoris
];

/// Place, diameter of the crater, and how far its rays reach, km.
const RAYED: [(Place, f64); 16] = [
    ((-43.3, -11.2, 85.0), 1500.0), // Tycho
    ((9.6, -20.1, 96.0), 480.0),    // Copernicus
    ((8.1, -38.0, 31.0), 300.0),    // Kepler
    ((23.7, -47.5, 40.0), 260.0),   // Aristarchus
    ((-8.9, 61.0, 132.0), 320.0),   // Langrenus
    ((16.1, 46.9, 28.0), 200.0),    // Proclus
    ((-32.5, 54.1, 72.0), 380.0),   // Stevinus
    ((-24.5, -63.7, 19.0), 260.0),  // Byrgius A
    ((73.5, -10.2, 51.0), 420.0),   // Anaxagoras
    ((61.7, 50.3, 31.0), 280.0),    // Thales
    ((16.3, 16.0, 27.0), 110.0),    // Menelaus
    ((2.8, 17.3, 18.0), 100.0),     // Dionysius
    ((-20.0, 57.0, 33.0), 260.0),   // Petavius B
    ((8.1, -77.7, 40.0), 300.0),    // Glushko
    ((-7.7, 26.0, 50.0), 90.0),     // Kant's bright slopes
    ((46.7, 44.4, 87.0), 120.0),    // Atlas
];

/// A plain's albedo over that of the highlands (Apollo's 0.065 against 0.12), and what the basalt keeps of red and blue.
const MARE: DVec3 = DVec3::new(0.53, 0.54, 0.56);
/// Height of flood at the shore of a lone circle, whose middle has 1.
const SHORE: f64 = 0.5;
/// How much brighter fresh rays are than the ground about them.
const RAYS: f64 = 0.55;

/// The picture, rows from the north, every texel red, green and blue.
pub(crate) fn face() -> &'static [[f32; 3]] {
    static FACE: LazyLock<Vec<[f32; 3]>> = LazyLock::new(paint);
    &FACE
}

/// Bilinear between the centres of texels, as the shader's sampler does; x and y in -1..1.
pub(crate) fn at(x: f64, y: f64) -> DVec3 {
    #[allow(clippy::cast_precision_loss, reason = "a few hundred texels")]
    let side = SIDE as f64;
    let place = DVec2::new((x + 1.0) / 2.0, (1.0 - y) / 2.0) * side - 0.5;
    let place = place.clamp(DVec2::ZERO, DVec2::splat(side - 1.001));
    let share = place.fract();
    let corner = place.floor().as_uvec2();
    let texel = |dx: u32, dy: u32| {
        let [r, g, b] = face()[(corner.y + dy) as usize * SIDE + (corner.x + dx) as usize];
        DVec3::new(f64::from(r), f64::from(g), f64::from(b))
    };
    texel(0, 0)
        .lerp(texel(1, 0), share.x)
        .lerp(texel(0, 1).lerp(texel(1, 1), share.x), share.y)
}

fn unit(latitude_deg: f64, longitude_deg: f64) -> DVec3 {
    let (sin_lat, cos_lat) = latitude_deg.to_radians().sin_cos();
    let (sin_lon, cos_lon) = longitude_deg.to_radians().sin_cos();
    DVec3::new(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat)
}

fn paint() -> Vec<[f32; 3]> {
    #[allow(clippy::cast_precision_loss, reason = "a few hundred texels")]
    let across = |i: usize| 2.0 * (i as f64 + 0.5) / SIDE as f64 - 1.0;
    let texels: Vec<(DVec3, f64)> = (0..SIDE * SIDE)
        .map(|i| {
            let p = DVec2::new(across(i % SIDE), -across(i / SIDE));
            // Beyond the limb, the limb: what a sampler mixes in there.
            let on_disc = if p.length() > 1.0 { p.normalize() } else { p };
            let towards = (1.0 - on_disc.length_squared()).max(0.0).sqrt();
            let weight = f64::from(u8::from(p.length() <= 1.0));
            (albedo(DVec3::new(towards, on_disc.x, on_disc.y)), weight)
        })
        .collect();
    let (sum, weights) = texels
        .iter()
        .fold((DVec3::ZERO, 0.0), |(sum, w), (albedo, weight)| {
            (sum + albedo * *weight, w + weight)
        });
    let mean = sum / weights;
    texels
        .iter()
        .map(|(albedo, _)| crate::uniforms::narrow3((*albedo / mean).to_array()).to_array())
        .collect()
}

/// Albedo of a place on the sphere over that of even highlands.
fn albedo(at: DVec3) -> DVec3 {
    // Shores are ragged: places are pushed about before they are looked up.
    let push = |scale: f64, seed: u32| {
        DVec3::new(
            noise(at * scale, seed),
            noise(at * scale, seed + 1),
            noise(at * scale, seed + 2),
        )
    };
    let pushed = (at + 0.075 * push(4.0, 1) + 0.03 * push(14.0, 11)).normalize();
    // Circles that come close flow into one another.
    let flooded: f64 = MARIA
        .iter()
        .map(|(latitude, longitude, km)| {
            let off_km = pushed.angle_between(unit(*latitude, *longitude)).to_degrees() * KM_PER_DEG;
            (SHORE.ln() * (2.0 * off_km / km).powi(4)).exp()
        })
        .sum();
    let sea = smooth((flooded - SHORE + 0.12 * noise(at * 9.0, 21)) / 0.3 + 0.5);
    // Basalt flows differ by a sixth; highlands are mottled by old craters.
    let flows = 1.0 + 0.22 * noise(at * 5.0, 5);
    let mottle = 1.0 + 0.12 * noise(at * 7.0, 6) + 0.16 * noise(at * 28.0, 7);
    let ground = DVec3::splat(mottle).lerp(MARE * flows, sea);
    ground * (1.0 + RAYS * rays(at).min(1.0) * (1.0 - 0.35 * sea))
}

/// Brightness of crater floors and rays at a place, 0 to about 1.
fn rays(at: DVec3) -> f64 {
    let mut sum = 0.0;
    for ((latitude, longitude, km), reach_km) in RAYED {
        let centre = unit(latitude, longitude);
        let off_km = at.angle_between(centre).to_degrees() * KM_PER_DEG;
        if off_km > reach_km {
            continue;
        }
        let rim = (-(off_km / (0.7 * km)).powi(2)).exp();
        // Streaks that depend on the way they were thrown, each with its own reach.
        let (east, north) = (DVec3::Z.cross(centre).normalize(), DVec3::Z - centre * centre.z);
        let thrown = DVec2::new(at.dot(east), at.dot(north.normalize())).normalize_or_zero();
        let streak =
            noise((thrown * 4.5).extend(longitude), 8) + 0.5 * noise((thrown * 11.0).extend(latitude), 9);
        let reach = smooth(0.5 + 1.4 * streak);
        let fade = (1.0 - off_km / reach_km).max(0.0).powi(2);
        sum += 0.9 * rim + 0.75 * fade * reach;
    }
    sum
}

fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Value noise in -1..1, three octaves.
fn noise(at: DVec3, seed: u32) -> f64 {
    (0..3_u32).fold(0.0, |sum, octave| {
        let scale = f64::from(1_u32 << octave);
        sum + lattice(at * scale + f64::from(octave) * 17.3, seed) / scale
    }) / 1.75
}

fn lattice(at: DVec3, seed: u32) -> f64 {
    let cell = at.floor();
    let share = (at - cell).to_array().map(smooth);
    let mut sum = 0.0;
    for corner in 0..8_u32 {
        let bit = |axis: usize| f64::from(corner >> axis & 1);
        let weight: f64 = (0..3)
            .map(|i| if bit(i) > 0.5 { share[i] } else { 1.0 - share[i] })
            .product();
        sum += weight
            * hash(
                (cell + DVec3::new(bit(0), bit(1), bit(2))).as_ivec3().to_array(),
                seed,
            );
    }
    sum
}

/// -1..1 (PCG, O'Neill 2014).
fn hash(cell: [i32; 3], seed: u32) -> f64 {
    let mut x = seed.wrapping_mul(0x9E37_79B9);
    for c in cell {
        x = (x ^ c.cast_unsigned())
            .wrapping_mul(747_796_405)
            .wrapping_add(2_891_336_453);
        x = ((x >> ((x >> 28) + 4)) ^ x).wrapping_mul(277_803_737);
        x ^= x >> 22;
    }
    f64::from(x) / f64::from(u32::MAX) * 2.0 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mean_of_the_disc_is_one() {
        let inside = (0..SIDE * SIDE).filter(|i| {
            let across = |i: usize| 2.0 * (i as f64 + 0.5) / SIDE as f64 - 1.0;
            across(i % SIDE).hypot(across(i / SIDE)) <= 1.0
        });
        let (sum, count) = inside.fold((0.0, 0.0), |(sum, n), i| (sum + f64::from(face()[i][1]), n + 1.0));
        // The texels are f32.
        assert!((sum / count - 1.0_f64).abs() < 1e-5, "{}", sum / count);
    }

    #[test]
    fn seas_are_dark_and_lie_where_they_should() {
        let seen = |latitude: f64, longitude: f64| {
            let n = unit(latitude, longitude);
            at(n.y, n.z).y
        };
        // Crisium in the north-east, Imbrium in the north-west, Nubium in the south-west; the southern highlands and
        // Tycho are bright.
        for (latitude, longitude) in [(17.0, 59.1), (32.8, -15.6), (-21.3, -16.6), (28.0, 17.5)] {
            assert!(seen(latitude, longitude) < 0.9, "{latitude} {longitude}");
        }
        for (latitude, longitude) in [(-43.3, -11.2), (-50.0, 20.0), (-25.0, 10.0)] {
            assert!(seen(latitude, longitude) > 1.1, "{latitude} {longitude}");
        }
    }
}
