"""An arch of nine stones on a base beside 3DEC 7.0: reactions and thrust.

    nine_stones.py FOLDER [--json]

FOLDER has geometry.dat of BlockResearchGroup/compas_3dec, docs/examples/2025_02_27 (MIT licence; not part of this project). The
joints are those of gravity.dat there: 60 and 25 GPa/m, 35 degrees, no sliding on the base. 3DEC's contact forces on the base
(contact_grav.txt) add up to 79.85 kN upwards and 11.89 kN inwards on each side. Exit status 1: more than 2 % from them.
"""
import json
import pathlib
import re
import sys
import tempfile

import ashlar

REACTION, THRUST, TOLERANCE = 79.85, 11.89, 0.02     # kN
BLOCK = re.compile(r'^block create group "\w+" poly (.*?)\s+r=(\d+)', re.MULTILINE)
LIGHT = ("1", "2", "8", "9")                         # the group "Cutout": 2400 kg/m^3, the others 10400


def as_obj(text):
    """The blocks as groups "stone0", "stone1", ... of an OBJ file. 3DEC's faces are clockwise from outside."""
    lines, count = [], 0
    for faces, region in BLOCK.findall(text):
        points, polygons = {}, []
        for face in faces.split("face")[1:]:
            polygons.append([points.setdefault(point, count + len(points) + 1) for point in reversed(face.split())])
        lines += [f"g stone{region}"] + [f"v {point.replace(',', ' ')}" for point in points]
        lines += ["f " + " ".join(map(str, polygon)) for polygon in polygons]
        count += len(points)
    return "\n".join(lines) + "\n"


def scene_of(mesh):
    stone = {"young_modulus": 3e10, "poisson_ratio": 0.2}
    return ashlar.Scene.from_dict({
        "title": "Nine stones",
        "analysis": {"type": "static"},
        # Coordinates are rounded to millimetres: some stones overlap by 0.3 mm.
        "contact": {"friction_angle": 35, "augmented": False, "normal_stiffness": 6e10, "shear_stiffness": 2.5e10,
                    "allowed_overlap": 2e-3},
        "joint": [{"blocks": ["arch.stone0", "*"], "friction_angle": 89.9}],
        "material": [{"name": "heavy", "density": 10400, **stone}, {"name": "light", "density": 2400, **stone}],
        "block": [{"name": "arch", "material": "heavy", "order": 0, "mesh": {"file": mesh, "split": "groups"}}],
        "assign": [{"blocks": ["arch.stone0"], "fixed": True},
                   {"blocks": [f"arch.stone{one}" for one in LIGHT], "material": "light"}]})


def forces_on_base(simulation):
    """N: of each stone on the base that it touches."""
    names, forces = list(simulation.blocks), {}
    for row in simulation.contacts():
        a, b = names[row["a"]], names[row["b"]]
        if "arch.stone0" in (a, b):
            other, sign = (b, 1) if a == "arch.stone0" else (a, -1)
            forces[other] = forces.get(other, 0) + sign * row["force"]
    return forces


def main(arguments):
    folder = pathlib.Path(arguments[0])
    with tempfile.TemporaryDirectory() as scratch:
        mesh = pathlib.Path(scratch) / "stones.obj"
        mesh.write_text(as_obj((folder / "geometry.dat").read_text(encoding="utf-8")), encoding="utf-8")
        simulation = scene_of(mesh).simulation()
        status = simulation.run(progress=False)
    sides = forces_on_base(simulation).values()
    found = {"reaction, kN": float(sum(-side[2] for side in sides)) / 2e3,
             "thrust, kN": float(sum(abs(side[0]) for side in sides)) / 2e3}
    checks = [{"what": what, "measured": found[what], "reference": reference, "error": abs(found[what] / reference - 1),
               "passed": status == "equilibrium" and abs(found[what] / reference - 1) <= TOLERANCE}
              for what, reference in (("reaction, kN", REACTION), ("thrust, kN", THRUST))]
    if "--json" in arguments:
        print(json.dumps({"name": "nine-stones", "checks": checks}))
    else:
        for check in checks:
            print(f"{check['what']}: {check['measured']:.3f}, 3DEC {check['reference']}, difference {check['error']:.1e}")
    return 0 if len(sides) == 2 and all(check["passed"] for check in checks) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
