"""A block falls on a slab: its height over time as a plot. Use: python3 falling_block.py PICTURE"""
import sys
import ashlar

stone = {"name": "stone", "density": 2500, "young_modulus": 1e9, "poisson_ratio": 0.2}
scene = ashlar.Scene.from_dict({
    "analysis": {"end_time": 0.6, "time_step": 1e-3}, "contact": {"friction_angle": 30}, "material": [stone],
    "block": [{"name": "slab", "fixed": True, "box": {"min": [-1, -1, -1], "max": [2, 2, 0]}},
              {"name": "cube", "material": "stone", "box": {"min": [0, 0, 0.5], "max": [1, 1, 1.5]}}],
    "measure": [{"name": "top", "block": "cube", "point": [0.5, 0.5, 1.5]}]})
sim = scene.simulation()
sim.run()
print(f"the top is {sim.history['top.z'][-1]:.4f} m above the slab")
if len(sys.argv) > 1:
    import matplotlib.pyplot as plot
    plot.plot(sim.history["time"], sim.history["top.z"])
    plot.xlabel("time, s"), plot.ylabel("height of the top, m")
    plot.savefig(sys.argv[1])
