"""Reads the files of write_samples with VTK's own reader and compares every number, bit for bit.

Use: read_samples.py WRITE_SAMPLES, the compiled program beside this script.
"""
import math
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkCommonCore import reference, vtkLogger
from vtkmodules.vtkCommonDataModel import (VTK_LAGRANGE_TETRAHEDRON, VTK_LAGRANGE_TRIANGLE, VTK_POLYGON, VTK_TETRA,
                                           VTK_TRIANGLE, VTK_VERTEX, vtkPlane)
from vtkmodules.vtkFiltersCore import vtkCutter, vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkFiltersGeneral import vtkClipDataSet
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersParallel import vtkIntegrateAttributes
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def read_grid(path):
    """The grid of a file; any complaint of VTK is an error."""
    complaints = []
    reader = vtkXMLUnstructuredGridReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda caller, name: complaints.append(name))
    reader.SetFileName(str(path))
    reader.Update()
    if complaints or reader.GetErrorCode():
        raise RuntimeError(f"VTK cannot read {path}: {complaints}, code {reader.GetErrorCode()}")
    return reader.GetOutput()


def tuples(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def bits(rows):
    """Exact values, so that -0.0 differs from 0.0 and nothing is rounded."""
    return [[struct.pack("<d", value) for value in row] for row in rows]


def arrays(data):
    return {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}


ORDERS = (2, 3, 5, 8, 12)


def bent(order, x, y, z):
    """Where write_samples puts the point (x, y, z) of the bar 2 x 1 x 1."""
    return x, y + x * z / 4, z + (x / 2) ** order / 2 + x * x / 16


def length_element(order, x):
    """Of the top face z = 1: |d/dx x d/dy| of (x, y + x / 4, 1 + (x / 2)^n / 2 + x^2 / 16)."""
    slope = order * (x / 2) ** (order - 1) / 4 + x / 8
    return math.hypot(1, slope)


def tessellated(grid, level):
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    surface.SetNonlinearSubdivisionLevel(level)
    surface.Update()
    return surface.GetOutput()


def plane_across_x(x):
    plane = vtkPlane()
    plane.SetOrigin(x, 0, 0)
    plane.SetNormal(1, 0, 0)
    return plane


def section_area(grid, x):
    cutter = vtkCutter()
    cutter.SetInputData(grid)
    cutter.SetCutFunction(plane_across_x(x))
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(cutter.GetOutputPort())
    mass = vtkMassProperties()
    mass.SetInputConnection(triangles.GetOutputPort())
    return mass.GetSurfaceArea()


def volume(grid, below=None):
    """By VTK's integration of what is below a plane across x, or of all."""
    integrate = vtkIntegrateAttributes()
    integrate.SetInputData(grid)
    if below is not None:
        clip = vtkClipDataSet()
        clip.SetInputData(grid)
        clip.SetClipFunction(plane_across_x(below))
        clip.InsideOutOn()
        integrate.SetInputConnection(clip.GetOutputPort())
    integrate.Update()
    return integrate.GetOutput().GetCellData().GetArray("Volume").GetTuple1(0)


def volume_within(surface):
    """Of a closed surface of triangles, by the divergence of x / 3."""
    total = 0
    for index in range(surface.GetNumberOfCells()):
        cell = surface.GetCell(index)
        (a, b, c), (d, e, f), (g, h, i) = (surface.GetPoint(cell.GetPointId(k)) for k in range(3))
        total += (a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)) / 6
    return total


def area_of_face(surface, height):
    """Area of the cells of the face whose points lie at this height where x is 0."""
    faces = arrays(surface.GetCellData())["face"]
    of_height = {}
    total = {}
    for index in range(surface.GetNumberOfCells()):
        cell = surface.GetCell(index)
        face = faces.GetValue(index)
        a, b, c = (surface.GetPoint(cell.GetPointId(k)) for k in range(3))
        of_height.setdefault(face, set()).update(round(p[2], 4) for p in (a, b, c) if abs(p[0]) < 1e-4)
        u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
        cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        total[face] = total.get(face, 0) + math.hypot(*cross) / 2
    (face,) = (face for face, heights in of_height.items() if heights == {height})
    return total[face]


class Samples(unittest.TestCase):
    folder = pathlib.Path()

    def grid(self, name):
        return read_grid(self.folder / "frames" / name)

    def assert_rows(self, array, rows):
        self.assertEqual(bits(tuples(array)), bits(rows))

    def test_points_and_cells(self):
        grid = self.grid("mixed.vtu")
        self.assertEqual(grid.GetPoints().GetData().GetDataTypeAsString(), "double")
        self.assert_rows(grid.GetPoints().GetData(), [(i + 0.1, -2.0 * i, i / 3.0) for i in range(8)])
        cells = []
        for index in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(index)
            points = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
            cells.append((grid.GetCellType(index), points))
        self.assertEqual(cells, [(VTK_TRIANGLE, [0, 1, 2]), (VTK_TRIANGLE, [2, 1, 3]),
                                 (VTK_POLYGON, [1, 3, 4, 5, 6]), (VTK_VERTEX, [7])])

    def test_point_data(self):
        data = arrays(self.grid("mixed.vtu").GetPointData())
        self.assertEqual(set(data), {"displacement", "stress", "gradient"})
        self.assert_rows(data["displacement"],
                         [[math.sqrt(i + 10.0 * k) for k in range(3)] for i in range(8)])
        self.assert_rows(data["stress"], [[1e6 * i - k / 7.0 for k in range(6)] for i in range(8)])
        self.assert_rows(data["gradient"], [[100.0 * i + k for k in range(9)] for i in range(8)])

    def test_component_names(self):
        data = arrays(self.grid("mixed.vtu").GetPointData())
        names = {name: [array.GetComponentName(i) for i in range(array.GetNumberOfComponents())]
                 for name, array in data.items()}
        self.assertEqual(names["displacement"], ["x", "y", "z"])
        self.assertEqual(names["stress"], ["xx", "yy", "zz", "xy", "yz", "xz"])
        self.assertEqual(names["gradient"], [None] * 9)

    def test_cell_data(self):
        data = arrays(self.grid("mixed.vtu").GetCellData())
        self.assertEqual(set(data), {'a < b & "c"', "block"})
        self.assert_rows(data['a < b & "c"'], [[-0.0], [5e-324], [math.inf], [0.1 + 0.2]])
        self.assertEqual(data["block"].GetDataTypeAsString(), "int")
        self.assertEqual(tuples(data["block"]), [(-1.0,), (0.0,), (2147483647.0,), (-2147483648.0,)])

    def test_time_and_block_names(self):
        data = self.grid("mixed.vtu").GetFieldData()
        self.assertEqual(data.GetArray("TimeValue").GetTuple(0), (0.1 + 0.2,))
        names = data.GetAbstractArray("block_names")
        self.assertEqual([names.GetValue(i) for i in range(names.GetNumberOfValues())],
                         ["a < b & c", "", "K\u00e4mpfer 1"])

    def test_empty_grid(self):
        grid = self.grid("empty.vtu")
        self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (0, 0))
        force = arrays(grid.GetPointData())["force"]
        self.assertEqual((force.GetNumberOfComponents(), force.GetNumberOfTuples()), (3, 0))
        self.assertEqual(arrays(grid.GetCellData())["state"].GetNumberOfTuples(), 0)

    def test_several_compressed_blocks(self):
        for count in (4096, 4097):
            with self.subTest(count=count):
                grid = self.grid(f"points_{count}.vtu")
                self.assertEqual(grid.GetNumberOfCells(), count)
                self.assert_rows(grid.GetPoints().GetData(),
                                 [(i, math.sin(i), 1.0 / (i + 1)) for i in range(count)])
                self.assert_rows(arrays(grid.GetPointData())["value"],
                                 [[math.sqrt(i)] for i in range(count)])

    def test_curved_cells(self):
        for order in ORDERS:
            with self.subTest(order=order):
                grid = self.grid(f"curved_{order}.vtu")
                self.assertEqual(grid.GetNumberOfCells(), 12)
                # A closed surface of 12 triangles has 8 corners and 18 sides.
                inside = (order - 1) * (order - 2) // 2
                self.assertEqual(grid.GetNumberOfPoints(), 8 + 18 * (order - 1) + 12 * inside)
                for index in range(12):
                    cell = grid.GetCell(index)
                    self.assertEqual(cell.GetCellType(), VTK_LAGRANGE_TRIANGLE)
                    self.assertEqual(cell.GetOrder(), order)

    def test_points_and_fields_of_curved_cells(self):
        for order in ORDERS:
            with self.subTest(order=order):
                grid = self.grid(f"curved_{order}.vtu")
                data = arrays(grid.GetPointData())
                self.assertEqual(set(data), {"displacement", "velocity", "stress"})
                for place, moved, velocity in zip(tuples(grid.GetPoints().GetData()), tuples(data["displacement"]),
                                                  tuples(data["velocity"])):
                    x, y, z = (p - u for p, u in zip(place, moved))
                    self.assert_near(place, bent(order, x, y, z))
                    self.assert_near(velocity, (z * z, 0, x))

    def test_vtk_finds_the_curved_face_between_the_points(self):
        """A wrong order of the points would put what VTK interpolates off the block."""
        numbers = random.Random(5)
        for order in ORDERS:
            grid = self.grid(f"curved_{order}.vtu")
            undeformed = [[p - u for p, u in zip(*rows)] for rows in
                          zip(tuples(grid.GetPoints().GetData()), tuples(arrays(grid.GetPointData())["displacement"]))]
            for index in range(12):
                cell = grid.GetCell(index)
                corners = [undeformed[cell.GetPointId(k)] for k in range(3)]
                for _ in range(10):
                    r, s = sorted((numbers.random(), numbers.random()))
                    shares = (1 - s, r, s - r)
                    material = [sum(w * c[k] for w, c in zip(shares, corners)) for k in range(3)]
                    place = [0.0, 0.0, 0.0]
                    cell.EvaluateLocation(reference(0), shares[1:] + (0,), place, [0.0] * cell.GetNumberOfPoints())
                    with self.subTest(order=order, cell=index):
                        self.assert_near(place, bent(order, *material))

    def test_area_of_a_curved_face(self):
        """The area of VTK's tessellation goes to the true one with the square of the size of its triangles."""
        for order in (2, 5):
            with self.subTest(order=order):
                grid = self.grid(f"curved_{order}.vtu")
                steps = 4000
                exact = sum(length_element(order, 2 * (k + 0.5) / steps) for k in range(steps)) * 2 / steps
                errors = [abs(area_of_face(tessellated(grid, level), 1) - exact) for level in (1, 2, 3)]
                for coarse, fine in zip(errors, errors[1:]):
                    self.assertAlmostEqual(coarse / fine, 4, delta=0.1)

    def test_solids_are_tetrahedra_that_clip_filled(self):
        grid = self.grid("solids.vtu")
        self.assertEqual({grid.GetCellType(k) for k in range(grid.GetNumberOfCells())}, {VTK_TETRA})
        # A box of 2 m^3, a frame of 8 m^3 from x = 4 to 7 with a hole from 5 to 6, a bar of 2 m^3.
        self.assertAlmostEqual(volume(grid) / 12, 1, delta=1e-12)
        for x, area in ((0.7, 2), (4.5, 3), (5.5, 2), (6.25, 3)):
            self.assertAlmostEqual(section_area(grid, x), area, delta=1e-6)
        for x, below in ((0.5, 1), (4.5, 4 + 1.5), (5.5, 4 + 3 + 1)):
            self.assertAlmostEqual(volume(grid, x), below, delta=1e-5)
        self.assertEqual(set(arrays(grid.GetCellData())), {"block", "order", "fixed"})
        principal = arrays(grid.GetPointData())["principal_stress"]
        self.assertEqual(principal.GetNumberOfComponents(), 3)

    def test_curved_solids(self):
        """The map has the determinant 1, so that the bent bar has the volume of the straight one."""
        for order in ORDERS:
            with self.subTest(order=order):
                grid = self.grid(f"solid_{order}.vtu")
                self.assertEqual(grid.GetNumberOfCells(), 12)
                for index in range(12):
                    self.assertEqual(grid.GetCellType(index), VTK_LAGRANGE_TETRAHEDRON)
                    self.assertEqual(grid.GetCell(index).GetOrder(), order)
                errors = [abs(volume_within(tessellated(grid, level)) - 2) for level in (2, 3)]
                self.assertLess(errors[1], max(errors[0] / 3.5, 1e-6))

    def test_vtk_finds_the_points_inside_curved_solids(self):
        numbers = random.Random(6)
        for order in ORDERS:
            grid = self.grid(f"solid_{order}.vtu")
            moved = tuples(arrays(grid.GetPointData())["displacement"])
            undeformed = [[p - u for p, u in zip(*rows)] for rows in zip(tuples(grid.GetPoints().GetData()), moved)]
            for index in range(12):
                cell = grid.GetCell(index)
                corners = [undeformed[cell.GetPointId(k)] for k in range(4)]
                for _ in range(5):
                    r, s, t = sorted(numbers.random() for _ in range(3))
                    shares = (1 - t, r, s - r, t - s)
                    material = [sum(w * c[k] for w, c in zip(shares, corners)) for k in range(3)]
                    place = [0.0, 0.0, 0.0]
                    cell.EvaluateLocation(reference(0), shares[1:], place, [0.0] * cell.GetNumberOfPoints())
                    with self.subTest(order=order, cell=index):
                        self.assert_near(place, bent(order, *material))

    def assert_near(self, seen, expected):
        for a, b in zip(seen, expected):
            self.assertAlmostEqual(a, b, delta=1e-10)

    def test_a_damaged_file_is_noticed(self):
        whole = (self.folder / "frames/mixed.vtu").read_bytes()
        damaged = self.folder / "damaged.vtu"
        # The end of the only block of the first array, which is the last one in the file.
        start = whole.index(b"\n  </AppendedData>") - 16
        damaged.write_bytes(whole[:start] + b"\xff" * 16 + whole[start + 16:])
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        with self.assertRaises(RuntimeError):
            read_grid(damaged)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)

    def test_series(self):
        root = ElementTree.parse(self.folder / "samples.pvd").getroot()
        self.assertEqual((root.tag, root.get("type")), ("VTKFile", "Collection"))
        frames = [(float(item.get("timestep")), item.get("file")) for item in root.iter("DataSet")]
        self.assertEqual(frames, [(0.0, "frames/empty.vtu"), (0.1 + 0.2, "frames/mixed.vtu")])
        for _, name in frames:
            read_grid(self.folder / name)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv.pop(1), folder], check=True)
        Samples.folder = pathlib.Path(folder)
        unittest.main(verbosity=2)
