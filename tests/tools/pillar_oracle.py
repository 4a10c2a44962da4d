"""Light that level plates of ice mirror from a lamp, by chance: plates are thrown into the air where an observer looks, each
is tilted at random, and what it mirrors of the lamp's light is counted where it meets a disc about the observer. It knows
nothing of the closed form that shaders use, and stands beside it in tests as its error bars allow.

    python3 pillar_oracle.py > ../oracles/pillar_plates.json

Numbers by numpy alone. For each direction asked, plates lie evenly in a cylinder about it; each has an axis drawn by the
tilt's law. The mirrored ray counts where it meets a disc of `DISC_M` about the observer from within `HALF_DEG` of that
direction, and where nothing stands on its way, or on the way from the lamp: a wall, or a ridge that is followed by small
steps.
"""

import json

import numpy as np

PLATES = 40_000_000
CHUNK = 2_000_000
DISC_M = 6.0
HALF_DEG = 0.6
STEPS = 600

LAMP = np.array([500.0, 0.0, 12.0])
VIEWER = np.array([0.0, 0.0, 40.0])
INTENSITY, FACE_PER_M, EXTINCTION, TOP_M, SIGMA_DEG, MAX_DEG = 1000.0, 1e-4, 3e-4, 220.0, 2.0, 6.0
LONGEST_M = 560.0
# Across the plane of lamp and observer; its upper edge.
WALL_X, WALL_TOP = 430.0, 26.0
# A ridge that runs aslant: where its crest is on the axis, how much it runs off, and its height, half-width and swell.
RIDGE_X, RIDGE_ASLANT, RIDGE_TOP, RIDGE_WIDTH, RIDGE_SWELL = 380.0, 0.4, 28.0, 50.0, 6.0
SCENES = {"wall": [4.0, 9.0, 14.0, 20.0], "ridge": [-2.0, 1.0, 4.0, 7.0, 10.0, 15.0, 22.0]}


def height(x, y):
    off = (x - RIDGE_X - RIDGE_ASLANT * y) / RIDGE_WIDTH
    return (RIDGE_TOP + RIDGE_SWELL * np.sin(y / 15.0)) * np.exp(-off * off)


def is_free(scene, a, b):
    """Whether nothing stands between places."""
    if scene == "wall":
        share = (WALL_X - a[:, 0]) / (b[:, 0] - a[:, 0])
        at = a[:, 2] + share * (b[:, 2] - a[:, 2])
        return (share < 0) | (share > 1) | (at > WALL_TOP)
    free = np.ones(len(a), bool)
    for share in (np.arange(STEPS) + 0.5) / STEPS:
        p = a + share * (b - a)
        free &= p[:, 2] > height(p[:, 0], p[:, 1])
    return free


def reflectance(cosine):
    n = 1.31
    t = np.sqrt(n * n - 1 + cosine**2)
    s = ((cosine - t) / (cosine + t)) ** 2
    p = ((n * n * cosine - t) / (n * n * cosine + t)) ** 2
    return s / (1 + s) + p / (1 + p)


def tilts(random, count):
    """exp(-d^2/2s^2) sin d, by weights on d exp(-d^2/2s^2)."""
    sigma, most = np.radians(SIGMA_DEG), np.radians(MAX_DEG)
    drawn = sigma * np.sqrt(-2 * np.log(1 - random.random(count) * (1 - np.exp(-0.5 * (most / sigma) ** 2))))
    return drawn, np.sin(drawn) / drawn


def thrown(random, scene, elevation_deg, mean_weight):
    """What one chunk of plates gives, W/m²/sr."""
    sine, cosine = np.sin(np.radians(elevation_deg)), np.cos(np.radians(elevation_deg))
    look, up, side = np.array([cosine, 0, sine]), np.array([-sine, 0, cosine]), np.array([0, 1.0, 0])
    radius = 2 * DISC_M + LONGEST_M * np.tan(np.radians(HALF_DEG))
    t, turn = LONGEST_M * random.random(CHUNK), 2 * np.pi * random.random(CHUNK)
    away = radius * np.sqrt(random.random(CHUNK))
    place = VIEWER + t[:, None] * look + away[:, None] * (np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * up)
    tilt, weight = tilts(random, CHUNK)
    turn = 2 * np.pi * random.random(CHUNK)
    axis = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], 1)
    off = place - LAMP
    r = np.linalg.norm(off, axis=1)
    beam = off / r[:, None]
    along = (beam * axis).sum(1)
    out = beam - 2 * along[:, None] * axis
    # Where the mirrored ray meets the disc, which faces the direction asked.
    back = -(out @ look)
    t = ((place - VIEWER) @ look) / np.maximum(back, 1e-9)
    meets = place + t[:, None] * out
    hit = (back > np.cos(np.radians(HALF_DEG))) & (t > 0) & (np.linalg.norm(meets - VIEWER, axis=1) < DISC_M)
    hit &= (place[:, 2] > 0) & (place[:, 2] < TOP_M)
    place, meets, r, t, along, weight = (a[hit] for a in (place, meets, r, t, along, weight))
    lit = is_free(scene, np.broadcast_to(LAMP, place.shape), place) & is_free(scene, place, meets)
    # Power on a plate |cos e| A I / r^2, all of it in one direction; over the disc's area, per steradian of the cone.
    power = lit * weight / mean_weight * np.abs(along) * reflectance(np.abs(along)) * INTENSITY / r**2
    power *= np.exp(-EXTINCTION * (r + t)) * FACE_PER_M * LONGEST_M * np.pi * radius**2 / CHUNK
    cone = 2 * np.pi * (1 - np.cos(np.radians(HALF_DEG)))
    return power.sum() / (np.pi * DISC_M**2 * cone)


def main():
    random = np.random.default_rng(6)
    mean_weight = tilts(random, 2_000_000)[1].mean()
    scenes = {}
    for scene, elevations in SCENES.items():
        scenes[scene] = []
        for elevation in elevations:
            found = np.array([thrown(random, scene, elevation, mean_weight) for _ in range(PLATES // CHUNK)])
            error = found.std(ddof=1) / np.sqrt(len(found))
            scenes[scene].append({"elevation_deg": elevation, "L": found.mean(), "error": error})
    print(json.dumps({"half_deg": HALF_DEG, "disc_m": DISC_M, "scenes": scenes}, indent=1))


if __name__ == "__main__":
    main()
