// Where the sky runs evenly, so that pixels can share what is found at a few places.
import package::lib::camera::{Sight, sight_at};
import package::lib::geometry::{angle_if_near, edge_cosine};
import package::lib::sky_light::{CLOUDS, MOON, PROJECTION, air, camera, moon, view};
import package::lib::tables::least_zenith_angle;

// Light of a run of pixels from that at its ends, where it runs evenly: both the angle from the zenith and that to the
// light change by less than a part of a table's cell, and the run stays away from the horizon by many times its own
// change, since there all runs by the distance from it. Seen from above, the air over the limb does not run evenly.
const EVEN_ANGLE = 0.025;
const EVEN_SHARE = 0.06;

fn is_even_run(mu_first: f32, mu_last: f32, length: f32) -> bool {
    let least_mu = cos(least_zenith_angle(air.radius_m, air.top_m, view.altitude_m));
    if view.altitude_m > air.top_m && min(mu_first, mu_last) > least_mu {
        // Nothing but space.
        return true;
    }
    let horizon_mu = edge_cosine(air.radius_m, view.altitude_m);
    let near = min(abs(mu_first - horizon_mu), abs(mu_last - horizon_mu));
    let one_side = (mu_first < horizon_mu) == (mu_last < horizon_mu);
    if CLOUDS && mu_first < horizon_mu {
        // The ground has shadows on it.
        return false;
    }
    let inside = mu_first < horizon_mu || view.altitude_m < 0.2 * air.top_m;
    let change = abs(mu_first - mu_last);
    return one_side && inside && length < EVEN_ANGLE && change < EVEN_SHARE * near && near > 2.0 * camera.pixel_angle;
}

// A cell of a preview's lattice is even where linear interpolation between its corners stays within a step of 8-bit
// colour, at dusk's horizon two. Over the horizon by an angle θ the light runs as a function of √θ: over a cell of height h the
// error is its slope by √θ times h²/32 θ^-3/2. So a cell keeps away from the horizon by its own height.
const CELL_SHARE = 1.0;
// And wherever it lies it spans no more than this of EVEN_ANGLE.
const CELL_ANGLES = 4.0;
// The lens' veil runs as 1/θ² about its source: its error is 3/4 (h/θ)² of itself.
const VEIL_CELLS = 6.0;
// As many radii of the sun its corona reaches in an eclipse.
const CORONA_RADII = 12.0;

// 0 for an uneven cell, 2 for an even one; 1 for one whose ground has shadows on it, which are finer than any angle tells.
// `veil`: whether the lens spreads light about `glaring`.
fn cell_evenness(place: vec2f, size: vec2f, veil: bool, glaring: vec3f) -> f32 {
    let a = sight_at(camera, PROJECTION, place);
    let b = sight_at(camera, PROJECTION, place + vec2f(size.x, 0.0));
    let c = sight_at(camera, PROJECTION, place + vec2f(0.0, size.y));
    let d = sight_at(camera, PROJECTION, place + size);
    let across = max(angle_if_near(a.direction, d.direction), angle_if_near(b.direction, c.direction));
    // The discs, drawn at most four pixels larger than they are.
    let off_sun = angle_if_near(a.direction, view.sun) - across - 4.0 * camera.pixel_angle;
    var clear = view.disc == 0.0 || off_sun > view.sun_angular_radius;
    clear &= !veil || angle_if_near(a.direction, glaring) > VEIL_CELLS * across;
    if MOON {
        let off_moon = angle_if_near(a.direction, moon.direction) - across - 4.0 * camera.pixel_angle;
        clear &= moon.disc == 0.0 || off_moon > moon.angular_radius;
        clear &= moon.sun_left > 0.01 || off_sun > CORONA_RADII * view.sun_angular_radius;
    }
    let mu = vec4f(dot(a.direction, view.up), dot(b.direction, view.up), dot(c.direction, view.up), dot(d.direction, view.up));
    let least = min(min(mu.x, mu.y), min(mu.z, mu.w));
    let most = max(max(mu.x, mu.y), max(mu.z, mu.w));
    let horizon_mu = edge_cosine(air.radius_m, view.altitude_m);
    let near = select(least - horizon_mu, horizon_mu - most, most < horizon_mu);
    var runs = near > 2.0 * camera.pixel_angle && most - least < CELL_SHARE * near && across < CELL_ANGLES * EVEN_ANGLE;
    // Seen from above, the air over the limb does not run evenly, and space over it does.
    runs &= most < horizon_mu || view.altitude_m < 0.2 * air.top_m;
    runs |= view.altitude_m > air.top_m && least > cos(least_zenith_angle(air.radius_m, air.top_m, view.altitude_m));
    let even = a.seen && b.seen && c.seen && d.seen && clear && runs;
    return select(0.0, select(2.0, 1.0, CLOUDS && least < horizon_mu), even);
}
