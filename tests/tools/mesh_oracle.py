"""What trimesh finds of the meshes that tests/tools/ground_assets.mjs makes: writes tests/oracles/ground_meshes.json.

    python3 -m venv venv && venv/bin/pip install trimesh numpy pillow scipy
    node tests/tools/ground_assets.mjs FOLDER && venv/bin/python tests/tools/mesh_oracle.py FOLDER

Counts, bounds, areas by material, and the normals of some vertices: those of the mountains as trimesh makes them from
the triangles, each by its angle at the vertex, those of the town by its faces.
"""

import json
import pathlib
import sys

import numpy as np
import trimesh

ORACLES = pathlib.Path(__file__).resolve().parent.parent / "oracles"
# Every so many vertices or triangles.
STRIDE = 997


def loaded(path):
    """The parts of a mesh, by material, vertices as they stand in the file."""
    found = trimesh.load(path, process=False, maintain_order=True, group_material=True)
    parts = found.geometry.values() if isinstance(found, trimesh.Scene) else [found]
    return {part.visual.material.name: part for part in parts}


def described(folder, name):
    parts = loaded(folder / name / f"{name}.obj")
    bounds = np.array([part.bounds for part in parts.values()])
    answer = {
        "triangles": int(sum(len(part.faces) for part in parts.values())),
        "least": bounds[:, 0].min(axis=0).tolist(),
        "most": bounds[:, 1].max(axis=0).tolist(),
        "materials": {
            material: {"triangles": len(part.faces), "area": float(part.area)} for material, part in sorted(parts.items())
        },
    }
    if len(parts) == 1:
        (part,) = parts.values()
        # What the file holds counts, were there any normals in it.
        part = trimesh.Trimesh(part.vertices, part.faces, process=False)
        some = range(0, len(part.vertices), STRIDE)
        answer["vertices"] = len(part.vertices)
        answer["vertex_normals"] = [
            {"at": part.vertices[i].tolist(), "normal": part.vertex_normals[i].tolist()} for i in some
        ]
    else:
        answer["face_normals"] = {
            material: [
                {"triangle": i, "at": part.triangles_center[i].tolist(), "normal": part.face_normals[i].tolist()}
                for i in range(0, len(part.faces), STRIDE)
            ]
            for material, part in sorted(parts.items())
        }
    return answer


def main():
    folder = pathlib.Path(sys.argv[1])
    answer = {"trimesh": trimesh.__version__} | {name: described(folder, name) for name in ("mountains", "town")}
    (ORACLES / "ground_meshes.json").write_text(json.dumps(answer, indent=1) + "\n")


if __name__ == "__main__":
    main()
