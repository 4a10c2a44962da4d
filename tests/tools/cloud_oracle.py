"""Renders the cloud of tests/oracles/cloud_scene.json by Mitsuba 3 and writes tests/oracles/cloud_radiance.json.

    python3 -m venv venv && venv/bin/pip install mitsuba numpy pillow
    DRJIT_LIBLLVM_PATH=/path/to/libLLVM.so venv/bin/python tests/tools/cloud_oracle.py [SUN...] [--passes N]

`volpath` follows every order of scattering through the lattice of tests/oracles/cloud_grid.png, with its values in the
middles of the cells and linear between them. Suns that are not named keep what the file says of them. Takes some ten
minutes for each sun on two cores.
"""

import argparse
import json
import math
import pathlib

import mitsuba as mi
import numpy as np
from PIL import Image

ORACLES = pathlib.Path(__file__).resolve().parent.parent / "oracles"
# Means over squares of the picture are kept.
BLOCKS = 16
FILM_PX = 64
SAMPLES = 64
# No more than the cloud can need: light that stays longer is under 1e-4 of all.
MOST_ORDERS = 3000


def unit(direction):
    azimuth, elevation = math.radians(direction["azimuth_deg"]), math.radians(direction["elevation_deg"])
    return np.array([math.sin(azimuth) * math.cos(elevation), math.cos(azimuth) * math.cos(elevation), math.sin(elevation)])


def lattice(document):
    """Extinction by height, north and east, 1/m."""
    cells = document["cube"]["cells"]
    picture = np.asarray(Image.open(ORACLES / "cloud_grid.png"), dtype=np.float32)
    layers = picture.reshape(cells // 8, cells, 8, cells).transpose(0, 2, 1, 3).reshape(cells, cells, cells)
    return layers / 255.0 * document["most_extinction_per_m"]


def phase(clouds):
    lobes = {"forward": 0.8, "backward": -0.25, "blend": 0.3} | clouds.get("phase", {})
    return {
        "type": "blendphase",
        "weight": lobes["blend"],
        "along": {"type": "hg", "g": lobes["forward"]},
        "against": {"type": "hg", "g": lobes["backward"]},
    }


def scene(document, extinction, sun):
    camera, cube = document["scene"]["camera"], document["cube"]
    at, ahead = np.array(camera["position_m"], dtype=float), unit(camera["direction"])
    place = mi.ScalarTransform4f().translate(cube["least_m"]).scale(cube["side_m"])
    return {
        "type": "scene",
        "integrator": {"type": "volpath", "max_depth": MOST_ORDERS, "rr_depth": MOST_ORDERS, "hide_emitters": True},
        "sun": {"type": "directional", "direction": list(-unit(sun)), "irradiance": 1.0},
        "camera": {
            "type": "perspective",
            "fov": camera["projection"]["vertical_fov_deg"],
            "to_world": mi.ScalarTransform4f().look_at(origin=list(at), target=list(at + 1000.0 * ahead), up=[0, 0, 1]),
            "film": {"type": "hdrfilm", "width": FILM_PX, "height": FILM_PX, "pixel_format": "luminance", "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": SAMPLES},
        },
        "cloud": {
            "type": "cube",
            "to_world": place.scale(0.5).translate([1, 1, 1]),
            "bsdf": {"type": "null"},
            "interior": {
                "type": "heterogeneous",
                "albedo": float(document["scene"]["clouds"]["albedo"]),
                "phase": phase(document["scene"]["clouds"]),
                "sigma_t": {
                    "type": "gridvolume",
                    "grid": mi.VolumeGrid(extinction[..., None]),
                    "to_world": place,
                    "wrap_mode": "clamp",
                    "filter_type": "trilinear",
                },
            },
        },
    }


def blocks(picture):
    side = FILM_PX // BLOCKS
    return picture.reshape(BLOCKS, side, BLOCKS, side).mean(axis=(1, 3))


def rendered(things, passes):
    """Means over the blocks, and their standard errors."""
    lit = mi.load_dict(things)
    found = np.array([blocks(np.array(mi.render(lit, seed=k))[..., 0]) for k in range(passes)])
    return found.mean(axis=0), found.std(axis=0, ddof=1) / math.sqrt(passes)


def transmittance(document, extinction):
    """What comes through a black cloud before a white sky."""
    things = scene(document, extinction, document["suns"]["high"])
    things["sun"] = {"type": "constant", "radiance": 1.0}
    things["integrator"]["hide_emitters"] = False
    things["cloud"]["interior"]["albedo"] = 0.0
    return rendered(things, 16)[0]


def rounded(rows, digits):
    return [[float(f"{v:.{digits}g}") for v in row] for row in rows]


def main():
    arguments = argparse.ArgumentParser()
    arguments.add_argument("suns", nargs="*")
    arguments.add_argument("--passes", type=int, default=24)
    arguments = arguments.parse_args()
    mi.set_variant("llvm_ad_mono")
    document = json.loads((ORACLES / "cloud_scene.json").read_text())
    extinction = lattice(document)
    path = ORACLES / "cloud_radiance.json"
    found = json.loads(path.read_text())["suns"] if path.exists() else {}
    for name, sun in document["suns"].items():
        if arguments.suns and name not in arguments.suns:
            continue
        mean, error = rendered(scene(document, extinction, sun), arguments.passes)
        print(f"{name}: mean {mean.mean():.5f}, standard error of bright blocks {np.median(error[mean > 0.02] / mean[mean > 0.02]):.4f}", flush=True)
        found[name] = {
            "radiance_per_sr": rounded(mean, 4),
            "standard_error_per_sr": rounded(error, 2),
        }
    rows = [f'"{name}":{json.dumps(found[name], separators=(",", ":"))}' for name in document["suns"] if name in found]
    head = {
        "what": "Radiance of the cloud of cloud_scene.json for unit irradiance, means over squares of the picture, rows from the top",
        "by": f"Mitsuba {mi.__version__}, volpath, at most {MOST_ORDERS} orders, {SAMPLES} samples a pixel of {FILM_PX} x {FILM_PX} in each of {arguments.passes} passes",
        "transmittance": rounded(transmittance(document, extinction), 4),
    }
    text = ",\n".join(f'"{key}":{json.dumps(value, separators=(",", ":"))}' for key, value in head.items())
    path.write_text("{" + text + ',\n"suns":{\n' + ",\n".join(rows) + "\n}}\n")


if __name__ == "__main__":
    main()
