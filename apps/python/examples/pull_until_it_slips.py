"""A cube is pulled harder from run to run until it slips: at tan(friction angle) times its weight."""
import ashlar

for share in (0.5, 0.55, 0.6, 0.65):
    scene = ashlar.Scene.from_dict({
        "analysis": {"end_time": 0.1, "time_step": 1e-3, "gravity": [0, 0, -10]}, "contact": {"friction_angle": 30},
        "material": [{"name": "stone", "density": 2000, "young_modulus": 1e9, "poisson_ratio": 0.0}],
        "block": [{"name": "floor", "fixed": True, "box": {"min": [-1, -1, -1], "max": [9, 2, 0]}},
                  {"name": "cube", "material": "stone", "box": {"min": [0, 0, 0], "max": [1, 1, 1]},
                   "load": [{"point": [1, 0.5, 0], "force": [share * 20000, 0, 0]}]}]})
    sim = scene.simulation()
    sim.run(callback=lambda s: s.blocks["cube"].displacements([[0.5, 0.5, 0.5]])[0, 0] < 1e-4)
    slips = sim.time < 0.1
    print(f"{share:.2f} of the weight: {'slips' if slips else 'holds'}")
    if slips:
        break
