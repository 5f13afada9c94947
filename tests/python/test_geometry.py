"""Contacts, moments, blocks and the schema from Python."""
import itertools

import pytest

import ashlar

CORNERS = [list(corner) for corner in itertools.product((0.0, 1.0), repeat=3)]
FACES = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
         [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]


def box(move=(0.0, 0.0, 0.0), size=(1.0, 1.0, 1.0)):
    return [[move[k] + size[k] * corner[k] for k in range(3)] for corner in CORNERS], FACES


def test_moments_of_a_box():
    moments = ashlar.integrate(box(size=(1.0, 2.0, 3.0)), 2)
    # Integral of x^i y^j z^k over [0, 1] x [0, 2] x [0, 3].
    for (i, j, k), value in moments.items():
        assert value == pytest.approx(1 / (i + 1) * 2 ** (j + 1) / (j + 1) * 3 ** (k + 1) / (k + 1), rel=1e-15)
    assert len(moments) == 10


@pytest.mark.parametrize("degree", [-1, 61, 1000])
def test_degrees_of_moments_are_bounded(degree):
    with pytest.raises(ValueError, match="degree is out of range"):
        ashlar.integrate(box(), degree)


def test_contacts_of_cubes():
    touching = ashlar.contacts(box(), box(move=(0.25, 0.0, 1.0)))
    assert touching["relation"] == "touching" and touching["type"] == "F-F"
    apart = ashlar.contacts(box(), box(move=(3.0, 0.0, 0.0)))
    assert apart["relation"] == "apart" and apart["squared_distance"] == 4.0
    with pytest.raises(ValueError):
        ashlar.contacts(box(), (CORNERS, FACES[:-1]))


def test_blocks_of_a_cut_rock(tmp_path):
    scene = ashlar.Scene.from_dict({
        "analysis": {"type": "static"},
        "material": [{"name": "rock", "density": 2700, "young_modulus": 1e10, "poisson_ratio": 0.2}],
        "block": [{"name": "base", "fixed": True, "box": {"min": [0, 0, -1], "max": [2, 1, 0]}},
                  {"name": "rock", "material": "rock", "box": {"min": [0, 0, 0], "max": [2, 1, 1]}}],
        "cut": [{"name": "middle", "blocks": ["rock"], "dip": 90, "dip_direction": 90, "point": [1, 0, 0]}],
    })
    found = ashlar.blocks(scene)
    assert found["count"] == 3 and found["volume"] == 4.0
    pieces = {block["name"]: block for block in found["blocks"]}
    assert pieces["rock.1"]["volume"] == pieces["rock.2"]["volume"] == 1.0
    assert {"block": "rock.2", "area": 1.0, "cut": "middle"} in pieces["rock.1"]["neighbours"]


def test_the_schema_knows_the_tables():
    assert {"analysis", "block", "stage"} <= set(ashlar.schema()["properties"])
