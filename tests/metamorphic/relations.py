"""Relations between scenes whose answers follow from each other.

A relation makes another scene of a scene, and says where vectors of its answers point and how long they are. Points,
vectors and axes of rotation are told apart by their keys.
"""
import copy
import dataclasses
import typing

POINTS = {"min", "max", "point", "center"}
VECTORS = {"gravity", "velocity", "force", "normal"}
AXES = {"angular_velocity"}
LENGTHS = {"radius", "height", "spacing"}
STRESSES = {"young_modulus", "cohesion", "tensile_strength"}
STIFFNESSES = {"normal_stiffness", "shear_stiffness"}  # Pa/m

Vector = typing.Callable[[list], list]


def same(vector):
    return vector


def each(value, change, key=None):
    """A table with change(key, value) in place of all values that are no tables or lists of tables."""
    if isinstance(value, dict):
        return {name: each(item, change, name) for name, item in value.items()}
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return [each(item, change) for item in value]
    return change(key, value)


def placed(scene, point, vector, axis, dip_direction):
    """The scene elsewhere. @param dip_direction of joint planes, degrees"""
    def change(key, value):
        for keys, map_ in ((POINTS, point), (VECTORS, vector), (AXES, axis)):
            if key in keys:
                return map_(value)
        return dip_direction(value) if key == "dip_direction" else value

    result = each(scene, change)
    for block in result["block"]:
        low, high = block["box"]["min"], block["box"]["max"]
        block["box"] = {"min": list(map(min, low, high)), "max": list(map(max, low, high))}
    return result


def reversed_blocks(scene):
    return {**scene, "block": scene["block"][::-1]}


def mirrored(vector):
    return [-vector[0], *vector[1:]]


def mirrored_axis(vector):
    return [vector[0], -vector[1], -vector[2]]


def mirror(scene):
    return placed(scene, mirrored, mirrored, mirrored_axis, lambda angle: (360.0 - angle) % 360.0)


def turned(vector):
    """By a quarter about z."""
    return [-vector[1], vector[0], vector[2]]


def quarter_turn(scene):
    return placed(scene, turned, turned, turned, lambda angle: (angle + 270.0) % 360.0)


def moved_on(vector):
    """z to x, x to y, y to z."""
    return [vector[2], vector[0], vector[1]]


def other_axes(scene):
    return placed(scene, moved_on, moved_on, moved_on, same)


def shift(scene):
    return placed(scene, lambda point: [point[0] + 4.0, point[1] - 8.0, point[2] + 2.0], same, same, same)


def heavier(scene):
    """Four times the masses, stiffnesses, strengths and forces."""
    def change(key, value):
        if key in STRESSES | STIFFNESSES | {"density"}:
            return 4.0 * value
        return [4.0 * x for x in value] if key == "force" else value

    return each(scene, change)


def longer(scene):
    """Lengths and accelerations doubled, times and densities the same: stresses are 4, forces 16 times as large."""
    def change(key, value):
        if key in POINTS | {"gravity", "velocity"}:
            return [2.0 * x for x in value]
        if key in LENGTHS | STIFFNESSES:
            return 2.0 * value
        if key in STRESSES:
            return 4.0 * value
        return [16.0 * x for x in value] if key == "force" else value

    return each(scene, change)


def renamed(scene):
    """Other names of all but measures, and the laws of contacts as those of a joint between all blocks."""
    names = {item["name"]: f"{9 - k}. {kind}" for kind in ("block", "masonry", "material")
             for k, item in enumerate(scene.get(kind, []))}

    def change(key, value):
        if isinstance(value, list) and value and isinstance(value[0], str):
            return [change(key, item) for item in value]
        if not isinstance(value, str) or key in ("type", "kind"):
            return value
        first, dot, rest = value.partition(".")
        return names.get(first, first) + dot + rest

    kept = copy.deepcopy(scene)
    measures = [item["name"] for item in kept["measure"]]
    result = each(kept, change)
    for item, name in zip(result["measure"], measures):
        item["name"] = name
    law = {key: result["contact"].pop(key) for key in ("friction_angle", "cohesion", "tensile_strength", "damping")
           if key in result["contact"]}
    result["joint"] = [{"blocks": ["*", "*"], **law}, *result.get("joint", [])]
    return result


@dataclasses.dataclass
class Relation:
    scene: typing.Callable[[dict], dict]
    bound: float  # of differences, of the largest such vector; 0: the same bits
    vector: Vector = same
    axis: Vector = same
    length: float = 1.0  # of displacements and velocities
    options: tuple = ("--threads", "1")


RELATIONS = {
    "order of blocks": Relation(reversed_blocks, 1e-9),
    "mirror": Relation(mirror, 1e-9, mirrored, mirrored_axis),
    "axes": Relation(other_axes, 1e-9, moved_on, moved_on),
    "quarter turn": Relation(quarter_turn, 1e-9, turned, turned),
    "shift": Relation(shift, 1e-9),
    "mass": Relation(heavier, 0.0),
    "length": Relation(longer, 1e-9, length=2.0),
    "names": Relation(renamed, 0.0),
    "threads": Relation(same, 0.0, options=("--threads", "2")),
}
