// Light in a cloud, and out of it.
import package::lib::geometry::PI;
import package::lib::cloud::clouds;
import package::lib::cloud_shade::slab_transmission;

fn henyey_greenstein(nu: f32, g: f32) -> f32 {
    let base = max((1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - nu), 1e-8);
    return (1.0 - g * g) / (4.0 * PI * base * sqrt(base));
}

// Draine 2003: Henyey and Greenstein's with 1 + α cos²θ; α = 0 gives theirs, and α = 1 that of Cornette and Shanks.
fn draine(nu: f32, g: f32, alpha: f32) -> f32 {
    return henyey_greenstein(nu, g) * (1.0 + alpha * nu * nu) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0);
}

// Two lobes whose weights sum to 1.
fn cloud_phase(nu: f32) -> f32 {
    return mix(henyey_greenstein(nu, clouds.forward), draine(nu, clouds.other, clouds.alpha), clouds.other_share);
}

// What light that has been scattered by small angles once, twice, ... eight times looks like in one direction, 1/sr. Henyey
// and Greenstein's function convolved n times with itself is that of g^{n+1}; orders beyond those asked for are none.
struct Lobes {
    first: vec4f,
    second: vec4f,
    // As many ones as there are orders.
    first_counts: vec4f,
    second_counts: vec4f,
    // Cosine of the angle with the light's way.
    nu: f32,
}

fn forward_lobes(nu: f32) -> Lobes {
    let orders = vec4f(f32(clouds.octaves));
    var lobes: Lobes;
    lobes.nu = nu;
    lobes.first_counts = select(vec4f(0.0), vec4f(1.0), vec4f(0.0, 1.0, 2.0, 3.0) < orders);
    lobes.second_counts = select(vec4f(0.0), vec4f(1.0), vec4f(4.0, 5.0, 6.0, 7.0) < orders);
    let f = clouds.forward;
    let f2 = f * f;
    let f4 = f2 * f2;
    let first = vec4f(f, f2, f2 * f, f4);
    lobes.first = lobes.first_counts * mix(henyey_greenstein_4(nu, first), vec4f(1.0 / (4.0 * PI)), clouds.other_share);
    lobes.second = lobes.second_counts * mix(henyey_greenstein_4(nu, f4 * first), vec4f(1.0 / (4.0 * PI)), clouds.other_share);
    lobes.first.x = cloud_phase(nu);
    return lobes;
}

fn henyey_greenstein_4(nu: f32, g: vec4f) -> vec4f {
    let base = max((1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - nu), vec4f(1e-8));
    return (1.0 - g * g) / (4.0 * PI * base * sqrt(base));
}

// Σ cₙ xⁿ/n! of eight coefficients.
fn exponential_sum(x: f32, first: vec4f, second: vec4f) -> f32 {
    var sum = second.z + x / 7.0 * second.w;
    sum = second.y + x / 6.0 * sum;
    sum = second.x + x / 5.0 * sum;
    sum = first.w + x / 4.0 * sum;
    sum = first.z + x / 3.0 * sum;
    sum = first.y + x / 2.0 * sum;
    return first.x + x * sum;
}

// Light of a far source of unit irradiance on a cloud, as the source function per unit albedo, 1/sr. `before` is the
// optical depth towards the source, `behind` that away from it.
//
// Photons that were scattered n times by small angles have gone e^{-τ} (gτ)^n / n! of the way's share: their sum is
// e^{-(1-g)τ}, light that similarity counts as unscattered, and their lobes are the silver lining, wider and fainter the
// deeper it comes from. The rest is diffuse: in the diffusion limit, with Eddington's closure and Marshak's boundaries, a
// slab of vertical depth T without absorption, all depths times 1-g, holds U(τ) = C₀ - 3 K τ - 3μ² E e^{-τ/μ} under light that
// falls at a cosine μ; K = μ E (2 + 3μ + (2 - 3μ) e^{-T/μ})/(4 + 3T) is what goes through all of it, C₀ = (3μ² + 2μ) E - 2K.
//
// That slab has no end; a heap loses light at its sides. `leak` is 0 for the slab and 1 for the heap: see `leaking`.
//
// Depths are those of the light's way, `cosine` is its own with the slab's upright. A heap has no slant.
fn lit_source(lobes: Lobes, cosine: f32, before: f32, behind: f32, leak: f32) -> vec3f {
    let upright = mix(cosine, 1.0, leak);
    let even = (1.0 - clouds.asymmetry) * upright;
    let near = even * before;
    let whole = even * (before + behind);
    var diffuse = 0.0;
    if leak <= 0.0 {
        diffuse = diffuse_in_slab(upright, near, whole);
    }
    if leak > 0.0 {
        diffuse = leaking(upright, near, whole, leak);
    }
    // Powder: at a sunlit rim there is little behind that could send light back (Schneider 2015). The slab knows that;
    // the control takes more.
    let powder = 1.0 - 0.5 * clouds.powder * exp(-before) * (0.5 - 0.5 * lobes.nu);
    return vec3f(forward_light(lobes, before)) + powder * absorbed(whole) * diffuse / (4.0 * PI);
}

// What comes straight or was scattered by small angles alone; of that, what the lobes leave out is even.
fn forward_light(lobes: Lobes, before: f32) -> f32 {
    let g = clouds.asymmetry;
    let x = g * before * clouds.albedo.g;
    let straight = exp(-before);
    let sum = straight * exponential_sum(x, lobes.first, lobes.second);
    let passed = straight * exponential_sum(x, lobes.first_counts, lobes.second_counts);
    return sum + max(exp(-(1.0 - g) * before) - passed, 0.0) / (4.0 * PI);
}

// U(τ) of light that falls at a cosine μ.
fn diffuse_in_slab(cosine: f32, near: f32, whole: f32) -> f32 {
    let through = cosine * slab_transmission(0.0, cosine, whole);
    return max(cosine * (3.0 * cosine + 2.0) - through * (2.0 + 3.0 * near) - 3.0 * cosine * cosine * exp(-near / cosine), 0.0);
}

// How deep in a slab, on the average, that is which is seen from one of its sides at a cosine: ∫ x e^{-x/μ} dx / ∫ e^{-x/μ} dx.
fn depth_seen(cosine: f32, whole: f32) -> f32 {
    let even = max(1.0 - clouds.asymmetry, 1e-3);
    let t = even * whole / cosine;
    // f32 loses the difference where there is little.
    let seen = select(1.0 - t / (exp(min(t, 80.0)) - 1.0), t * (0.5 - t / 12.0), t < 0.05);
    return min(seen * cosine / even, whole);
}

// U(τ) of a column that loses light at its sides. Across a square of width W, with U = 0 at Milne's 2/3 beyond its sides,
// the slowest mode cos(πx/w) cos(πy/w), w = W + 4/3, gives U'' = m² U - 3E e^{-τ/μ}, m = π√2/w. A heap is about as wide as
// deep: W = 4T/3 brings pictures of one cloud at several densities closest to a path tracer's (`tests/clouds/mitsuba.rs`). Then
// m = 3π√2/4/(1 + T), and U = c e^{-τ/μ} + p e^{-mτ} + q e^{-m(T-τ)}, c = 3E μ²/(m²μ² - 1), with Marshak's boundaries at both ends.
fn leaking(cosine: f32, near: f32, whole: f32, leak: f32) -> f32 {
    let wanted = leak * HEAP / (1.0 + whole) * cosine;
    // c has a pole at mμ = 1 which p and q cancel; f32 does not.
    let turned = select(wanted, 1.01, abs(wanted - 1.0) < 0.01);
    let m = turned / cosine;
    let c = 3.0 * cosine * cosine / (turned * turned - 1.0);
    let across = exp(-m * whole);
    let out = 1.0 + 2.0 / 3.0 * m;
    let back = (1.0 - 2.0 / 3.0 * m) * across;
    let slope = 2.0 / (3.0 * cosine);
    let top = -(1.0 + slope) * c;
    let base = -(1.0 - slope) * c * exp(-whole / cosine);
    let scale = 1.0 / (out * out - back * back);
    let down = exp(-m * near);
    return max(c * exp(-near / cosine) + scale * ((top * out - base * back) * down + (base * out - top * back) * across / down), 0.0);
}

const HEAP = 3.3322;

// What absorption leaves of light that has been scattered often: diffusion's √(3(1-ω)(1-ωg)) times the way.
fn absorbed(depth: f32) -> vec3f {
    let g = clouds.asymmetry;
    let a = clouds.albedo;
    return a * exp(-sqrt(max(3.0 * (1.0 - a) * (1.0 - a * g), vec3f(0.0))) / (1.0 - g) * min(depth, 4.0));
}

// The same of even light of unit irradiance on one side, `near` of it: U = 4 - 2 C₁ - 3 C₁ τ, C₁ = 4/(4 + 3T).
fn ambient_source(near: f32, far: f32) -> vec3f {
    let g = clouds.asymmetry;
    let depth = (1.0 - g) * near;
    let whole = depth + (1.0 - g) * far;
    let c1 = 4.0 / (4.0 + 3.0 * whole);
    return absorbed(whole) * (4.0 - 2.0 * c1 - 3.0 * c1 * depth) / (4.0 * PI);
}
