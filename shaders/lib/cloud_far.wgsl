// Clouds so far away that a pixel holds many of their heaps and gaps: the mean over the coarse noise takes its place.

// Billows of the coarse noise are spread evenly from here to there, whatever the seed.
const BILLOWS = vec2f(0.37, 0.985);
// Width of heaps and gaps as a share of the coarse noise's scale.
const CLUMP = 0.12;
// As such shares, what pixels span from which on the noise begins to be a mean, and is one alone.
const BLURRED = vec2f(0.02, 0.09);

// ∫ of clamp(x, 0, most) from 0 to x.
fn integral_clamped(x: f32, most: f32) -> f32 {
    let within = clamp(x, 0.0, most);
    return 0.5 * within * within + most * max(x - most, 0.0);
}

struct Clumps {
    // Share of the places that have cloud, and its density there.
    share: f32,
    density: f32,
}

// Density rises evenly with the noise from `least` to `most`, and is none below 0 and no more than `full`.
fn clumps_between(least: f32, most: f32, full: f32) -> Clumps {
    let width = max(most - least, 1e-5);
    let share = clamp(most / width, 0.0, 1.0);
    let mean = (integral_clamped(most, full) - integral_clamped(least, full)) / width;
    return Clumps(share, select(0.0, mean / share, share > 0.0));
}

// Extinction of even cloud that lets through over a clump's width what clumps and gaps do on average:
// e^{-κL} = 1 - s + s e^{-σL}.
fn clumped_extinction(share: f32, extinction_per_m: f32, width_m: f32) -> f32 {
    // What f32 cannot tell from nothing is dark enough.
    return -log(max(1.0 - share * (1.0 - exp(-extinction_per_m * width_m)), 1e-7)) / width_m;
}
