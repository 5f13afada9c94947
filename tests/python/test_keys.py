"""Scenes from tables of ashlar.keys."""
import dataclasses

import ashlar
import pytest
from ashlar import keys

CUBES = {
    "analysis": {"type": "static"},
    "material": [{"name": "rock", "density": 2500, "young_modulus": 1e9, "poisson_ratio": 0.2}],
    "block": [{"name": "floor", "fixed": True, "box": {"min": [0, 0, -1], "max": [1, 1, 0]}},
              {"name": "cube", "material": "rock", "box": {"min": [0, 0, 0], "max": [1, 1, 1]},
               "load": [{"point": [0.5, 0.5, 1], "force": [0, 0, -1e3]}]}],
    "prop": [{"name": "strut", "from": [0.5, 0.5, -0.5], "to": [0.5, 0.5, 0.5], "stiffness": 1e6}],
}


def test_tables_are_the_scene_of_a_dictionary():
    load = keys.BlockLoad(point=[0.5, 0.5, 1], force=[0, 0, -1e3])
    scene = ashlar.Scene(
        analysis=keys.Analysis(type="static"),
        material=[keys.Material(name="rock", density=2500, young_modulus=1e9, poisson_ratio=0.2)],
        block=[keys.Block(name="floor", fixed=True, box=keys.Box(min=[0, 0, -1], max=[1, 1, 0])),
               keys.Block(name="cube", material="rock", box={"min": [0, 0, 0], "max": [1, 1, 1]}, load=[load])],
        prop=[keys.Prop(name="strut", from_=[0.5, 0.5, -0.5], to=[0.5, 0.5, 0.5], stiffness=1e6)])
    assert scene.to_dict() == ashlar.Scene.from_dict(CUBES).to_dict()


def test_every_table_of_the_schema_is_a_class():
    for key, schema in ashlar.schema()["properties"].items():
        table = schema.get("items", schema)
        if "properties" not in table:
            continue
        made = getattr(keys, "".join(part.title() for part in key.split("_")))
        fields = {field.metadata["key"]: field for field in dataclasses.fields(made)}
        assert fields.keys() == table["properties"].keys()
        required = {name for name, field in fields.items() if field.default is dataclasses.MISSING}
        assert required == set(table.get("required", []))


def test_help_has_units_and_meanings():
    assert "yield_force: N, of the steel" in keys.Bolt.__doc__


def test_wrong_keys_are_refused():
    with pytest.raises(TypeError, match="stifness"):
        keys.Prop(name="strut", from_=[0, 0, 0], to=[0, 0, 1], stiffness=1, stifness=1)
    with pytest.raises(TypeError, match="text or from tables"):
        ashlar.Scene()
