"""Checks `ashlar schema` with an independent validator.

Every scene of data/scenes and every complete one of a list of faults is read by Python's own TOML reader and validated.
Use: check_schema.py ASHLAR SCENES_FOLDER
"""
import json
import pathlib
import subprocess
import sys
import tomllib

import jsonschema


def main(program, folder):
    schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    # The copy for editors, named by the first line of each scene.
    copy = pathlib.Path(folder).parent / "scene.schema.json"
    assert json.loads(copy.read_text()) == schema, f"{copy} is out of date: ashlar schema > {copy}"
    validator = jsonschema.Draft202012Validator(schema)
    scenes = sorted(pathlib.Path(folder).glob("*.toml"))
    assert len(scenes) > 10, f"{len(scenes)} scenes in {folder}"
    for path in scenes:
        assert path.read_text().startswith("#:schema ../scene.schema.json\n"), f"{path}: no line for editors"
        for error in validator.iter_errors(tomllib.loads(path.read_text())):
            sys.exit(f"{path}: {list(error.path)}: {error.message}")

    good = tomllib.loads((pathlib.Path(folder) / "slope.toml").read_text())
    formula = json.loads(json.dumps(good))
    formula["analysis"]["end_time"] = "= 2*3"
    assert validator.is_valid(formula), "a formula"

    def refuses(what, change):
        scene = json.loads(json.dumps(good))
        change(scene)
        assert not validator.is_valid(scene), f"the schema lets pass: {what}"

    refuses("an unknown key", lambda s: s["analysis"].update(end_tme=1))
    refuses("a wrong type", lambda s: s["analysis"].update(end_time="soon"))
    refuses("a number out of range", lambda s: s["material"][0].update(poisson_ratio=0.7))
    refuses("an unknown word", lambda s: s["analysis"].update(integrator="verlet"))
    refuses("a missing name", lambda s: s["material"][0].pop("name"))
    refuses("a vector of two", lambda s: s["analysis"].update(gravity=[0, 1]))
    refuses("a table in place of a list", lambda s: s.update(block={}))
    print(f"{len(scenes)} scenes and 8 variants")


main(*sys.argv[1:])
