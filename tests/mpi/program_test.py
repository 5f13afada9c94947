"""Runs of the program on several ranks: messages once, the same results, the end of a rank.

Use: program_test.py MPIEXEC ASHLAR SCENES [TEST...]; MPIEXEC is a command, e.g. "mpiexec --oversubscribe"; TEST is a class, as
StagesTest, one of its tests, as StagesTest.test_stages_move_alike_on_many_ranks, or -k and a part of a name
"""
import pathlib
import sys
import unittest

from ranks_messages import MessagesTest
from ranks_motion import MotionTest
from ranks_runs import Program
from ranks_searches import SearchesTest
from ranks_stages import StagesTest
from ranks_statics import StaticsTest
from ranks_work import WorkTest

__all__ = ["MessagesTest", "MotionTest", "SearchesTest", "StagesTest", "StaticsTest", "WorkTest"]

if __name__ == "__main__":
    Program.mpiexec, Program.ashlar, Program.scenes = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
