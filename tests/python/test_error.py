"""Estimated errors of a simulation."""
import pytest

import ashlar


@pytest.mark.parametrize("order, estimate", [(1, 0.5), (2, 0.0)])
def test_the_error_of_orders_is_estimated(order, estimate):
    """A bar hangs in its own weight: order 1 has 3/4 of the strain energy, order 2 all of it."""
    bar = ashlar.Scene.from_dict({
        "analysis": {"end_time": 1e-3, "time_step": 1e-3, "initial_state": "equilibrium"},
        "material": [{"name": "m", "density": 2500, "young_modulus": 1e7, "poisson_ratio": 0}],
        "block": [{"name": "bar", "material": "m", "order": order, "box": {"min": [0, 0, 0], "max": [1, 1, 2]},
                   "fix": [{"plane": {"point": [0, 0, 2], "normal": [0, 0, 1]}}]}]})
    sim = bar.simulation()
    sim.run()
    assert sim.error["estimate"] == pytest.approx(estimate, abs=1e-3)
    assert [block["block"] for block in sim.error["blocks"]] == (["bar"] if order == 1 else [])
    assert (sim.error["blocks_estimated"], sim.error["blocks_in_all"]) == (1, 1)
    assert sim.error == sim.summary["error"]


def test_the_error_of_measures_is_estimated():
    """With s from its support the bar moves by rho g (h s - s^2 / 2) / E, of order 1 by rho g h s / 2 E."""
    bar = ashlar.Scene.from_dict({
        "analysis": {"type": "static"},
        "material": [{"name": "m", "density": 2500, "young_modulus": 1e8, "poisson_ratio": 0}],
        "block": [{"name": "bar", "material": "m", "order": 1, "box": {"min": [0, 0, 0], "max": [1, 1, 2]},
                   "fix": [{"plane": {"point": [0, 0, 2], "normal": [0, 0, 1]}}]}],
        "measure": [{"name": "middle", "block": "bar", "point": [0.5, 0.5, 1]},
                    {"name": "end", "block": "bar", "point": [0.5, 0.5, 0]}]})
    sim = bar.simulation()
    assert sim.error is None or "measures" not in sim.error
    sim.run()
    assert sim.error["measures"] == pytest.approx({"middle": 1 / 3, "end": 0}, abs=1e-5)
