"""Displacement of a stone on a slope of 30 degrees in half a second, by its friction angle."""
import math
import ashlar

gravity = [9.81 * math.sin(math.radians(30)), 0, -9.81 * math.cos(math.radians(30))]
for angle in (10, 20, 29, 35):
    scene = ashlar.Scene.from_dict({
        "analysis": {"end_time": 0.5, "time_step": 1e-3, "gravity": gravity}, "contact": {"friction_angle": angle},
        "material": [{"name": "stone", "density": 2500, "young_modulus": 1e9, "poisson_ratio": 0.2}],
        "block": [{"name": "slope", "fixed": True, "box": {"min": [-1, -1, -1], "max": [9, 2, 0]}},
                  {"name": "stone", "material": "stone", "box": {"min": [0, 0, 0], "max": [1, 1, 1]}}]})
    sim = scene.simulation()
    sim.run()
    print(f"{angle} degrees: {sim.blocks['stone'].displacements([[0.5, 0.5, 0]])[0, 0]:.4f} m")
