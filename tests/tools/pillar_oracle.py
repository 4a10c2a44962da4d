"""Light that level plates of ice mirror from a lamp, by chance: plates are thrown into the air about their lamp, each is
tilted at random, and what it mirrors is counted where it meets a small sphere about the observer. It knows nothing of the
closed form that shaders use, and stands beside it in tests as its error bars allow.

    python3 pillar_oracle.py > ../oracles/pillar_plates.json

Numbers by numpy alone. A beam leaves the lamp evenly in all directions and meets plates evenly along its way, up to a wall
or the layer's end; each has an axis drawn by the tilt's law. The mirrored ray is asked how near it comes to the line of
sight: directions within `HALF_DEG` of the one asked, hitting a disc of `DISC_M` about the observer, are counted.
"""

import json

import numpy as np

RAYS = 100_000_000
CHUNK = 4_000_000
DISC_M = 6.0
HALF_DEG = 0.6

LAMP = np.array([500.0, 0.0, 12.0])
VIEWER = np.array([0.0, 0.0, 40.0])
INTENSITY, FACE_PER_M, EXTINCTION, TOP_M, SIGMA_DEG, MAX_DEG = 1000.0, 1e-4, 3e-4, 220.0, 2.0, 6.0
# Across the plane of lamp and observer; its upper edge.
WALL_X, WALL_TOP = 430.0, 26.0
ELEVATIONS = [4.0, 9.0, 14.0, 20.0]


def reflectance(cosine):
    n = 1.31
    t = np.sqrt(n * n - 1 + cosine**2)
    s = ((cosine - t) / (cosine + t)) ** 2
    p = ((n * n * cosine - t) / (n * n * cosine + t)) ** 2
    return s / (1 + s) + p / (1 + p)


def tilts(random, count):
    """exp(-d^2/2s^2) sin d, by rejection from d exp(-d^2/2s^2)."""
    sigma, most = np.radians(SIGMA_DEG), np.radians(MAX_DEG)
    drawn = sigma * np.sqrt(-2 * np.log(1 - random.random(count) * (1 - np.exp(-0.5 * (most / sigma) ** 2))))
    return drawn, np.sin(drawn) / drawn


def main():
    random = np.random.default_rng(6)
    sums, squares = np.zeros(len(ELEVATIONS)), np.zeros(len(ELEVATIONS))
    drawn_tilt, weight_tilt = tilts(random, 2_000_000)
    mean_weight = weight_tilt.mean()
    # Plates are drawn in a slab about the upright plane, wide enough for all that can be mirrored to the disc.
    half_width = 60.0
    volume = 500.0 * 2 * half_width * TOP_M
    for _ in range(RAYS // CHUNK):
        place = random.random((CHUNK, 3)) * [500.0, 2 * half_width, TOP_M] - [0, half_width, 0]
        tilt, weight = tilts(random, CHUNK)
        turn = 2 * np.pi * random.random(CHUNK)
        axis = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], 1)
        off = place - LAMP
        r = np.linalg.norm(off, axis=1)
        beam = off / r[:, None]
        along = (beam * axis).sum(1)
        out = beam - 2 * along[:, None] * axis
        to_viewer = VIEWER - place
        t = (to_viewer * out).sum(1)
        miss = np.linalg.norm(to_viewer - t[:, None] * out, axis=1)
        hit = (t > 0) & (miss < DISC_M)
        if not hit.any():
            continue
        place, beam, out, r, t, along, weight = (a[hit] for a in (place, beam, out, r, t, along, weight))
        at_wall = LAMP[2] + beam[:, 2] * (LAMP[0] - WALL_X) / -beam[:, 0]
        lit = (place[:, 0] > WALL_X) | (at_wall > WALL_TOP)
        # Power on a plate |cos e| A I / r^2, all of it in one direction; over the disc's area, per steradian of the cone.
        power = lit * weight / mean_weight * np.abs(along) * reflectance(np.abs(along)) * INTENSITY / r**2
        power *= np.exp(-EXTINCTION * (r + t)) * FACE_PER_M * volume / CHUNK
        for i, elevation in enumerate(ELEVATIONS):
            look = -np.array([np.cos(np.radians(elevation)), 0, np.sin(np.radians(elevation))])
            near = (out * look).sum(1) > np.cos(np.radians(HALF_DEG))
            cone = 2 * np.pi * (1 - np.cos(np.radians(HALF_DEG)))
            found = power[near].sum() / (np.pi * DISC_M**2 * cone)
            sums[i] += found
            squares[i] += found**2
    chunks = RAYS // CHUNK
    mean = sums / chunks
    error = np.sqrt(np.maximum(squares / chunks - mean**2, 0) / chunks)
    values = [{"elevation_deg": e, "L": m, "error": s} for e, m, s in zip(ELEVATIONS, mean, error)]
    print(json.dumps({"half_deg": HALF_DEG, "disc_m": DISC_M, "values": values}, indent=1))


if __name__ == "__main__":
    main()
