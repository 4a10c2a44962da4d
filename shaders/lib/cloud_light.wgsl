// Light in a cloud, and out of it.
import package::lib::geometry::PI;
import package::lib::cloud::clouds;

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

// Light of a far source of unit irradiance on a cloud, as the source function per unit albedo, 1/sr. `before` is the
// optical depth towards the source, `behind` that away from it.
//
// Photons that were scattered n times by small angles have gone e^{-τ} (gτ)^n / n! of the way's share: their sum is
// e^{-(1-g)τ}, light that similarity counts as unscattered. Henyey and Greenstein's function convolved n times with itself
// is that of g^{n+1}: this is the silver lining, wider and fainter the deeper it comes from. The rest is diffuse:
// in the diffusion limit, with Eddington's closure and Marshak's boundaries, a slab of depth T = (1-g)(before + behind)
// without absorption holds U(τ) = C₀ - 3 C₁ τ - 3 E e^{-τ}, C₁ = E (5 - e^{-T})/(4 + 3T), C₀ = 5E - 2C₁.
fn lit_source(nu: f32, before: f32, behind: f32) -> vec3f {
    let g = clouds.asymmetry;
    let a = clouds.albedo.g;
    var sum = cloud_phase(nu) * exp(-before);
    var weight = exp(-before);
    var lobe = clouds.forward;
    var passed = weight;
    for (var n = 1u; n < clouds.octaves; n++) {
        weight *= g * before * a / f32(n);
        lobe *= clouds.forward;
        passed += weight;
        sum += weight * mix(henyey_greenstein(nu, lobe), 1.0 / (4.0 * PI), clouds.other_share);
    }
    let near = (1.0 - g) * before;
    let whole = near + (1.0 - g) * behind;
    // Of the forward light, what the loop left out is even.
    sum += max(exp(-near) - passed, 0.0) / (4.0 * PI);
    let c1 = (5.0 - exp(-whole)) / (4.0 + 3.0 * whole);
    let diffuse = max(5.0 - 2.0 * c1 - 3.0 * c1 * near - 3.0 * exp(-near), 0.0);
    // Powder: at a sunlit rim there is little behind that could send light back (Schneider 2015). The slab knows that;
    // the control takes more.
    let powder = 1.0 - 0.5 * clouds.powder * exp(-before) * (0.5 - 0.5 * nu);
    return vec3f(sum) + powder * absorbed(whole) * diffuse / (4.0 * PI);
}

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
