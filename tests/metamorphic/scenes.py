"""Small scenes, as the tables of their TOML files. Coordinates are multiples of 2^-10 m, so that scenes are
mirrored, shifted and scaled by powers of two without rounding."""

def box(name, low, high, **more):
    return {"name": name, "material": "rock", "box": {"min": list(map(float, low)), "max": list(map(float, high))},
            **more}


def floor(**more):
    return box("floor", (-4, -4, -1), (4, 4, 0), fixed=True, **more)


def scene(analysis, contact, blocks, measured, young_modulus=1e9, **more):
    """@param measured names of blocks that are followed as a whole"""
    return {"analysis": {"gravity": [0.0, 0.0, -9.81], **analysis}, "contact": contact,
            "material": [{"name": "rock", "density": 2500.0, "young_modulus": young_modulus, "poisson_ratio": 0.2}],
            "block": blocks, "measure": [{"name": f"of {name}", "block": name} for name in measured], **more}


def landing():
    """The first impacts of a stone that spins, on another one that rests. Later ones hang on roundings: which of two corners
    strikes first."""
    result = impact()
    result["analysis"]["end_time"] = 0.09
    result["contact"]["restitution"] = 0.25
    return result


def impact():
    """A stone that spins lands on another one with a corner, then on the floor; springs stand for the joints."""
    return scene({"end_time": 0.25, "time_step": 1e-3}, {"friction_angle": 25.0, "restitution": "springs"},
                 [floor(), box("lower", (-0.5, -0.625, 0), (0.5, 0.5, 0.75)),
                  box("upper", (0.125, -0.25, 0.875), (0.875, 0.25, 1.375), velocity=[-1.0, 0.25, -2.0],
                      angular_velocity=[1.0, 2.0, 0.5])], ["lower", "upper"])


def static():
    """A block of order 2 under one of order 1 that is pushed at its side; springs stand for the joints."""
    return scene({"type": "static"}, {"friction_angle": 35.0, "augmented": False},
                 [floor(), box("lower", (-0.5, -0.5, 0), (0.5, 0.5, 1), order=2),
                  box("upper", (-0.5, -0.5, 1), (0.5, 0.5, 2),
                      load=[{"point": [-0.5, 0.125, 1.5], "force": [4096.0, 0.0, 0.0]}])], ["lower", "upper"])


def rigid():
    """Two equal rigid cubes, the upper one thrown along the lower one."""
    return scene({"end_time": 0.2, "time_step": 1e-3},
                 {"friction_angle": 30.0, "normal_stiffness": 2e10, "restitution": "springs"},
                 [floor(), box("lower", (-0.5, -0.5, 0), (0.5, 0.5, 1), order=0),
                  box("upper", (-0.25, -0.375, 1), (0.75, 0.625, 2), order=0, velocity=[0.5, 0.25, 0.0])],
                 ["lower", "upper"])


def high_order():
    """A cube hits the free end of a cantilever of order 3, flush with it."""
    return scene({"end_time": 0.06, "time_step": 1e-3}, {"friction_angle": 30.0},
                 [box("cube", (7, -0.5, 0.5), (8, 0.5, 1.5), velocity=[0.0, 0.0, -2.0]),
                  box("beam", (0, -0.5, -0.5), (8, 0.5, 0.5), order=3,
                      fix=[{"plane": {"point": [0.0, 0.0, 0.0], "normal": [-1.0, 0.0, 0.0]}}])],
                 ["cube", "beam"], young_modulus=5e8)


def friction():
    """Equal bricks side by side and on each other, one of them pushed through."""
    return scene({"end_time": 0.1, "time_step": 1e-3}, {"friction_angle": 20.0},
                 [floor(), box("left", (-1, -0.25, 0), (0, 0.25, 0.5)), box("right", (0, -0.25, 0), (1, 0.25, 0.5)),
                  box("top", (-0.625, -0.25, 0.5), (0.375, 0.25, 1),
                      load=[{"point": [-0.625, 0.125, 0.75], "force": [8192.0, 0.0, 0.0]}])],
                 ["left", "right", "top"])


def cohesion():
    """A bonded block is torn off its base by a load that grows."""
    return scene({"end_time": 0.1, "time_step": 1e-3},
                 {"friction_angle": 30.0, "cohesion": 2e4, "tensile_strength": 1e4},
                 [floor(), box("post", (-0.25, -0.25, 0), (0.25, 0.25, 1.5),
                               load=[{"point": [-0.25, 0.0625, 1.25], "force": [4096.0, 0.0, 0.0],
                                      "history": [[0.0, 0.0], [0.0625, 1.0]]}])], ["post"])


def damping():
    """Equal blocks on joints with dashpots."""
    return scene({"end_time": 0.1, "time_step": 1e-3, "mass_damping": 0.5}, {"friction_angle": 30.0, "damping": 0.25},
                 [floor(), box("lower", (-0.5, -0.5, 0), (0.5, 0.5, 1)),
                  box("upper", (-0.375, -0.5, 1), (0.625, 0.5, 2), velocity=[0.5, 0.0, 0.0])], ["lower", "upper"])


def cut_rock():
    """Rock that two sets of joints have cut, on a floor that ends; pieces on its edge fall."""
    return scene({"end_time": 0.1, "time_step": 2e-3}, {"friction_angle": 25.0},
                 [box("ground", (-4, -4, -1), (0, 4, 0), fixed=True),
                  box("rock", (-1, -0.75, 0), (1.25, 1, 1.5), order=1)], [f"rock.{k}" for k in range(1, 8)],
                 cut=[{"name": "bedding", "blocks": ["rock"], "dip": 30.0, "dip_direction": 90.0, "spacing": 0.75,
                       "point": [0.0, 0.0, 0.5]},
                      {"name": "cross", "blocks": ["rock"], "dip": 70.0, "dip_direction": 250.0,
                       "point": [0.25, 0.0, 0.5]}])


def masonry():
    """A column of drums that is pushed near its top."""
    return scene({"end_time": 0.1, "time_step": 1e-3}, {"friction_angle": 30.0}, [floor(), box("stone", (0.5625, -0.25, 0), (1.0625, 0.25, 0.375))],
                 ["column.1", "column.2", "column.3", "stone"],
                 masonry=[{"name": "column", "kind": "column", "material": "rock", "radius": 0.5, "height": 2.25,
                           "sides": 8, "drums": 3, "center": [0.0, 0.0, 0.0]}],
                 assign=[{"blocks": ["column.3"], "load": [{"point": [0.0, 0.0, 2.0], "force": [8192.0, 1024.0, 0.0]}]}])


def stages():
    """A block at rest on two others; one of them is taken away."""
    return scene({"type": "static"}, {"friction_angle": 35.0, "augmented": False},
                 [floor(), box("left", (-1, -0.25, 0), (-0.5, 0.25, 0.5)), box("right", (0.5, -0.25, 0), (1, 0.25, 0.5)),
                  box("lintel", (-1, -0.25, 0.5), (1, 0.25, 0.75))], ["left", "lintel"],
                 stage=[{"name": "built"},
                        {"name": "dug", "remove": ["right"], "analysis": {"type": "dynamic", "end_time": 0.05,
                                                                           "time_step": 1e-3}}])


def multipliers():
    """A block that slides and tilts on a joint without compliance."""
    return scene({"end_time": 0.1, "time_step": 1e-3}, {"friction_angle": 20.0, "augmented": True},
                 [floor(), box("stone", (-0.5, -0.375, 0), (0.5, 0.375, 1), velocity=[2.0, 0.5, 0.0])], ["stone"])


def generalized_alpha():
    """Blocks of order 2 that part after an impact."""
    return scene({"end_time": 0.05, "time_step": 1e-3, "integrator": "generalized-alpha"}, {"friction_angle": 30.0},
                 [floor(), box("lower", (-0.5, -0.625, 0), (0.5, 0.5, 0.75), order=2),
                  box("upper", (-0.25, -0.375, 0.75), (0.75, 0.625, 1.25), order=2, velocity=[0.0, 0.25, -1.0])],
                 ["lower", "upper"], young_modulus=5e7)


def pushed_wall():
    """Bricks in bond, of which the topmost is pushed along the wall until some slide or tilt."""
    bricks = [box(f"brick.{row}.{k}", (k + 0.5 * (row % 2), 0, 0.5 * row), (k + 1 + 0.5 * (row % 2), 0.5, 0.5 * row + 0.5),
                  order=0) for row in range(3) for k in range(3 - row % 2)]
    bricks[-1]["load"] = [{"point": [3.0, 0.25, 1.375], "force": [1024.0, 0.0, 0.0]}]
    return scene({"type": "capacity"}, {"friction_angle": 35.0}, [floor(), *bricks], [])


def slope():
    """Rock on a steep face that two oblique sets of joints have cut: a network of wedges."""
    return scene({"type": "factor-of-safety"}, {"friction_angle": 35.0},
                 [box("ground", (-4, -4, -1), (0, 4, 0), fixed=True), box("back", (-4, -4, 0), (-2, 4, 2), fixed=True),
                  box("rock", (-2, -1, 0), (0, 1, 1.5), order=0)], [],
                 cut=[{"name": "bedding", "blocks": ["rock"], "dip": 28.0, "dip_direction": 75.0, "spacing": 0.75,
                       "point": [-0.5, 0.0, 0.5]},
                      {"name": "cross", "blocks": ["rock"], "dip": 62.0, "dip_direction": 160.0, "spacing": 1.0,
                       "point": [-0.75, 0.125, 0.5]}])


def leaning_stack():
    """Deformable bricks whose tilt is half of their friction, bonded in part."""
    return scene({"type": "factor-of-safety", "gravity": [2.75, 0.0, -9.25]}, {"friction_angle": 32.0},
                 [floor(), *(box(f"brick.{k}", (0, 0, 0.5 * k), (1, 0.75, 0.5 * k + 0.5)) for k in range(3))], [],
                 joint=[{"blocks": ["brick.1", "brick.2"], "friction_angle": 40.0}])


SCENES = {function.__name__: function for function in (
    impact, landing, static, rigid, high_order, friction, cohesion, damping, cut_rock, masonry, stages, multipliers,
    generalized_alpha)}

# Their answers are factors, in brackets.
SEARCHES = {function.__name__: function for function in (pushed_wall, slope, leaning_stack)}
