"""The fit and the extrapolation of scaling.py, on rows of known coefficients."""
import math
import unittest

import cost_model
import scaling


def row(ranks, blocks, ghosts, points, iterations, solutions, own, memory, sent, calls):
    return scaling.RankRow(scene="cube:1", ranks=ranks, all_blocks=blocks * ranks, blocks=blocks, ghosts=ghosts, points=points,
                           iterations=iterations, unknowns=12 * blocks, solutions=solutions, calls=calls, messages=0,
                           bytes=sent, result_bytes=0, own=own, shared=0, waiting=0, memory=memory)


def exact_rows():
    """0.05 s, 2e-4 s a block, 1e-4 s a ghost, 3e-6 s a point and iteration; 50 MB, 20 kB a block and ghost, 3 kB of each
    block of the run; 700 bytes a ghost and 100 in each solution, 16 a call and other rank; 20 calls, 4 an iteration, 8 a
    solution."""
    rows = []
    for ranks, blocks, ghosts, iterations, solutions in ((2, 50, 10, 5, 5), (4, 30, 22, 6, 9), (8, 20, 31, 5, 30), (64, 10, 40, 9, 3),
                                                         (2, 400, 60, 4, 2), (2, 90, 5, 3, 8), (16, 5, 60, 12, 20)):
        points = 90 * blocks
        calls = 20 + 4 * iterations + 8 * solutions
        rows.append(row(ranks, blocks, ghosts, points, iterations, solutions,
                        own=0.05 + 2e-4 * blocks + 1e-4 * ghosts + 3e-6 * points * iterations,
                        memory=5e7 + 2e4 * (blocks + ghosts) + 3e3 * blocks * ranks,
                        sent=(700 + 100 * solutions) * ghosts + 16 * (ranks - 1) * calls, calls=calls))
    return rows


class FitTest(unittest.TestCase):
    def test_coefficients_of_exact_rows(self):
        fit = cost_model.fitted(exact_rows())
        expected = {"own": {"start": 0.05, "block": 2e-4, "ghost": 1e-4, "point": 3e-6},
                    "memory": {"base": 5e7, "of_own": 2e4, "of_all": 3e3},
                    "bytes": {"per_ghost": 700, "per_solution": 100, "per_call": 16},
                    "calls": {"first": 20, "per_iteration": 4, "per_solution": 8}}
        for quantity, values in expected.items():
            found, error = fit[quantity]
            self.assertLess(error, 1e-6, quantity)
            for name, value in values.items():
                self.assertLess(abs(found[name] / value - 1), 1e-4, f"{quantity} {name}")

    def test_no_coefficient_is_negative(self):
        # 1 + 0 and 1 + 1 give 2 and 1: without the bound the second is -1. Relative squares (x/2 - 1)^2 + (x - 1)^2 are
        # least for x = 6/5.
        x = cost_model.least_squares([(1, 0), (1, 1)], [2, 1])
        self.assertAlmostEqual(x[0], 1.2, places=9)
        self.assertEqual(x[1], 0.0)
        self.assertAlmostEqual(cost_model.worst([(1, 0), (1, 1)], [2, 1], x), 0.4, places=9)

    def test_nothing_to_fit_is_an_error(self):
        with self.assertRaises(ValueError):
            cost_model.least_squares([(1, 2)], [0])


class StepTest(unittest.TestCase):
    def test_ghosts_of_a_cube(self):
        self.assertAlmostEqual(cost_model.ghosts_of_cube(1000), 12**3 - 10**3)

    def test_parts_of_a_step(self):
        fit = cost_model.fitted(exact_rows())
        step = cost_model.step_on(fit, 8000, 8, {"points": 90, "iterations": 5, "solutions": 5}, searches=1.0, assumed={
            "latency": 1e-6, "bandwidth": 1e9, "set_up": 1e-4, "per_iteration": 1e-6, "gradient_iterations": 100,
            "box_bytes": 50})
        # 1000 blocks and 728 ghosts a rank, 3 hops; 20 + 4 * 5 + 8 * 5 = 80 calls.
        expected = {"own part": 0.2 + 0.0728 + 3e-6 * 90000 * 5, "linear systems": 5 * (12000 * 2e-4 + 100 * 3 * 3e-6),
                    "waiting for collective calls": 80 * 3e-6, "bytes": (1200 * 728 + 16 * 7 * 80) / 1e9,
                    "search for ghosts": 50 * 8000 / 1e9, "memory": 5e7 + 2e4 * 1728 + 3e3 * 8000}
        self.assertEqual(step.keys(), expected.keys())
        for part, value in expected.items():
            self.assertLess(abs(step[part] / value - 1), 1e-4, part)

    def test_one_rank_waits_for_none(self):
        fit = cost_model.fitted(exact_rows())
        step = cost_model.step_on(fit, 1000, 1, {"points": 90, "iterations": 5, "solutions": 5})
        self.assertEqual(step["waiting for collective calls"], 0.0)


class SummaryTest(unittest.TestCase):
    def test_rows_are_of_one_step(self):
        rank = {"blocks": 3, "ghosts": 2, "contact_points": 40, "unknowns": 36, "collective_calls": 30, "messages_sent": 24,
                "bytes_sent": 900, "peak_memory_bytes": 7,
                "shared_systems": {"unknowns": 36, "factorizations": 8, "solutions": 12, "conjugate_gradient_iterations": 0},
                "processor_seconds": {"total": 5.0, "own_part": 2.0, "shared_systems": 2.0, "in_messages": 1.0},
                "for_results": {"collective_calls": 10, "messages_sent": 4, "bytes_sent": 500}}
        found = scaling.rows_of("wall:2", 2, {
            "steps": 4, "blocks": 6, "counts": {"open_close_iterations": 20}, "ranks": [rank, rank],
            "wall_seconds": {"total": 9, "setup": 1, "solve": 4, "contact_search": 2, "output": 2}})
        self.assertEqual(found.wall, 1.5)
        first = found.rows[0]
        self.assertEqual((first.points, first.iterations, first.solutions, first.calls, first.messages, first.bytes),
                         (10, 5, 3, 5, 5, 100))
        self.assertEqual((first.own, first.shared, first.waiting), (0.5, 0.5, 0.25))
        self.assertIn("| wall:2 | 2 | 3 | 2 | 10 |", scaling.counts_table([found]))

    def test_scenes(self):
        self.assertIn("length = 5.0, height = 1.5", scaling.scene_text("wall:10", 3))
        self.assertEqual(scaling.scene_text("cube:4", 3).count("spacing = 1"), 3)
        with self.assertRaises(ValueError):
            scaling.scene_text("ball:3", 3)

    def test_model_of_exact_rows_is_told(self):
        text = scaling.model_text(exact_rows())
        self.assertIn("| own | block | 0.0002 | 0 % |", text)
        self.assertIn("| 1,000,000 | 1000 |", text)
        self.assertTrue(math.isfinite(float(text.strip().splitlines()[-1].split("|")[-3])))


if __name__ == "__main__":
    unittest.main()
