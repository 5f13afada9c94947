"""Reads samples.vtkhdf of write_samples with HDF5's and VTK's own readers: structure and types of the published format,
and every number of every frame, bit for bit, as in the .vtu files of the same grids.

Use: read_vtkhdf.py WRITE_SAMPLES    the compiled program beside this script
     read_vtkhdf.py FOLDER           that it has filled
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

# File of each frame of a series; None: no points.
FRAMES = {"mixed": ["mixed", "mixed", "mixed"], "curved": ["curved_2", "curved_3", "curved_5"],
          "points": [None, "points_4096", "points_4097"], "rounded": ["rounded", "rounded", "rounded"]}
NAMES = ["a < b & c", "", "K\u00e4mpfer 1"]
KINDS = {"PointData": "PointOffsets", "CellData": "CellOffsets"}
READS_COLLECTIONS = (vtkVersion.GetVTKMajorVersion(), vtkVersion.GetVTKMinorVersion(),
                     vtkVersion.GetVTKBuildVersion()) >= (9, 3, 20240000)


def same_bits(a, b):
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def arrays(data):
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}


def grid_values(grid):
    """Points, cells and fields of a VTK grid."""
    cells = grid.GetCells()
    return {"points": vtk_to_numpy(grid.GetPoints().GetData()) if grid.GetNumberOfPoints() else np.zeros((0, 3)),
            "types": vtk_to_numpy(grid.GetCellTypesArray()) if grid.GetNumberOfCells() else np.zeros(0, np.uint8),
            "offsets": vtk_to_numpy(cells.GetOffsetsArray()).astype(np.int64),
            "connectivity": vtk_to_numpy(cells.GetConnectivityArray()).astype(np.int64),
            **{("PointData", name): values for name, values in arrays(grid.GetPointData()).items()},
            **{("CellData", name): values for name, values in arrays(grid.GetCellData()).items()}}


def frame_values(series, k):
    """The same of a frame, by the offsets that the format defines."""
    steps = series["Steps"]
    part, cell = steps["PartOffsets"][k], steps["CellOffsets"][k, 0]
    points, cells = series["NumberOfPoints"][part], series["NumberOfCells"][part]
    start, ids = steps["PointOffsets"][k], steps["ConnectivityIdOffsets"][k, 0]
    values = {"points": series["Points"][start:start + points], "types": series["Types"][cell:cell + cells],
              "offsets": series["Offsets"][cell + part:cell + part + cells + 1],
              "connectivity": series["Connectivity"][ids:ids + series["NumberOfConnectivityIds"][part]]}
    for kind, count in (("PointData", points), ("CellData", cells)):
        for name in series[kind]:
            start = steps[f"{kind}Offsets/{name}"][k]
            values[kind, name] = series[kind][name][start:start + count]
    return values


def expected_values(folder, name):
    if name is None:
        return {"points": np.zeros((0, 3)), "types": np.zeros(0, np.uint8), "offsets": np.zeros(1, np.int64),
                "connectivity": np.zeros(0, np.int64), ("PointData", "value"): np.zeros(0)}
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "frames" / (name + ".vtu")))
    reader.Update()
    return grid_values(reader.GetOutput())


class OneFile(unittest.TestCase):
    folder = pathlib.Path()

    @classmethod
    def setUpClass(cls):
        cls.file = h5py.File(cls.folder / "samples.vtkhdf", "r")
        cls.root = cls.file["VTKHDF"]

    def assert_values(self, found, expected, where):
        self.assertEqual(set(found), set(expected), where)
        for key, values in expected.items():
            self.assertTrue(same_bits(found[key], values), f"{where}: {key}")

    def assert_text_attribute(self, group, name, text):
        """A text of ASCII and fixed length, as VTK's reader asks for."""
        attribute = h5py.h5a.open(group.id, name.encode())
        kind = attribute.get_type()
        self.assertIsInstance(kind, h5py.h5t.TypeStringID)
        self.assertFalse(kind.is_variable_str())
        self.assertEqual((kind.get_cset(), kind.get_size()), (h5py.h5t.CSET_ASCII, len(text)))
        self.assertEqual(attribute.shape, ())
        self.assertEqual(group.attrs[name], text.encode())

    def test_collection(self):
        self.assert_text_attribute(self.root, "Type", "PartitionedDataSetCollection")
        self.assertEqual(list(self.root.attrs["Version"]), [2, 2])
        self.assertEqual(list(self.root), ["Assembly", *FRAMES])
        self.assertEqual(list(self.root["Assembly"]), list(FRAMES))
        for index, name in enumerate(FRAMES):
            self.assertEqual(list(self.root["Assembly"][name]), [name])
            link = self.root["Assembly"][name].get(name, getlink=True)
            self.assertIsInstance(link, h5py.SoftLink)
            self.assertEqual(link.path, "/VTKHDF/" + name)
            self.assert_text_attribute(self.root[name], "Type", "UnstructuredGrid")
            self.assertEqual(list(self.root[name].attrs["Version"]), [2, 2])
            self.assertEqual(self.root[name].attrs["Index"], index)
            self.assertEqual(self.root[name].attrs["Index"].shape, ())

    def test_members_keep_their_order(self):
        flags = h5py.h5p.CRT_ORDER_TRACKED | h5py.h5p.CRT_ORDER_INDEXED
        for group in (self.root, self.root["Assembly"], self.root["Assembly/mixed"]):
            self.assertEqual(group.id.get_create_plist().get_link_creation_order(), flags)

    def test_datasets(self):
        integers = np.dtype("<i8")
        for name, files in FRAMES.items():
            series, steps = self.root[name], self.root[name]["Steps"]
            self.assertEqual(steps.attrs["NSteps"], 3)
            self.assertEqual(list(steps["Values"]), [0.0, 0.1, 0.2])
            self.assertEqual(list(steps["NumberOfParts"]), [1, 1, 1])
            real = np.dtype("<f4" if name == "rounded" else "<f8")
            kinds = {"Points": (real, 2), "Types": (np.dtype("u1"), 1), "Connectivity": (integers, 1),
                     "Offsets": (integers, 1), "NumberOfPoints": (integers, 1), "NumberOfCells": (integers, 1),
                     "NumberOfConnectivityIds": (integers, 1), "Steps/PartOffsets": (integers, 1),
                     "Steps/PointOffsets": (integers, 1), "Steps/CellOffsets": (integers, 2),
                     "Steps/ConnectivityIdOffsets": (integers, 2), "Steps/NumberOfParts": (integers, 1),
                     "Steps/Values": (np.dtype("<f8"), 1)}
            for kind, offsets in KINDS.items():
                kinds |= {f"Steps/{kind}Offsets/{field}": (integers, 1) for field in series[kind]}
            for dataset, (dtype, dimensions) in kinds.items():
                self.assertEqual((series[dataset].dtype, series[dataset].ndim), (dtype, dimensions), dataset)
            for dataset in ("PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"):
                self.assertEqual(len(steps[dataset]), len(files))
            for dataset in ("Points", "Types", "Connectivity", "PointData/" + list(series["PointData"])[0]):
                self.assertEqual((series[dataset].compression, series[dataset].shuffle), ("gzip", True), dataset)

    def test_single_precision_is_the_nearest(self):
        series = self.root["rounded"]
        self.assertTrue(same_bits(series["PointData/value"][:100], np.sqrt(np.arange(100.0)).astype("<f4")))
        self.assertTrue(same_bits(series["Points"][:100, 0], np.arange(100, dtype="<f4")))
        self.assertEqual(list(series["Steps/PointOffsets"]), [0, 0, 0])

    def test_names_are_no_fields(self):
        for name in FRAMES:
            series = self.root[name]
            self.assertEqual(list(series["FieldData"]), ["step", "block_names"])
            self.assertEqual([text.decode() for text in series["FieldData/block_names"]], NAMES)
            self.assertEqual(list(series["FieldData/step"]), [0, 10, 20])
            self.assertEqual(series["Steps/FieldDataSizes/block_names"][:].tolist(), [[1, 3]] * 3)
            self.assertEqual(series["Steps/FieldDataSizes/step"][:].tolist(), [[1, 1]] * 3)
            self.assertEqual(list(series["Steps/FieldDataOffsets/step"]), [0, 1, 2])

    def test_every_frame(self):
        for name, files in FRAMES.items():
            for k, file in enumerate(files):
                self.assert_values(frame_values(self.root[name], k), expected_values(self.folder, file), (name, k))

    def test_a_frame_alone_is_read_by_vtk(self):
        """Readers before 9.4 know neither times nor collections: a frame as a file of version 1.0."""
        for name, files in FRAMES.items():
            for k, file in enumerate(files):
                if file is None:
                    continue
                values = frame_values(self.root[name], k)
                path = self.folder / f"{name}_{k}.hdf"  # readers keep theirs open
                with h5py.File(path, "w") as alone:
                    group = alone.create_group("VTKHDF")
                    group.attrs["Version"] = [1, 0]
                    group.attrs.create("Type", b"UnstructuredGrid", dtype=h5py.string_dtype("ascii", 16))
                    for dataset, key in (("Points", "points"), ("Types", "types"), ("Offsets", "offsets"),
                                         ("Connectivity", "connectivity")):
                        group[dataset] = values[key]
                    group["NumberOfPoints"] = [len(values["points"])]
                    group["NumberOfCells"] = [len(values["types"])]
                    group["NumberOfConnectivityIds"] = [len(values["connectivity"])]
                    for key, array in values.items():
                        if isinstance(key, tuple):
                            group["/".join(key)] = array
                    self.file.copy(f"VTKHDF/{name}/FieldData/block_names", group.create_group("FieldData"))
                reader = vtkHDFReader()
                reader.SetFileName(str(path))
                reader.Update()
                grid = reader.GetOutputAsDataSet()
                self.assert_values(grid_values(grid), expected_values(self.folder, file), (name, k))
                names = grid.GetFieldData().GetAbstractArray("block_names")
                self.assertEqual([names.GetValue(i) for i in range(names.GetNumberOfValues())], NAMES)

    @unittest.skipUnless(READS_COLLECTIONS, "this VTK knows no collections with times")
    def test_the_file_is_read_by_vtk(self):
        reader = vtkHDFReader()
        reader.SetFileName(str(self.folder / "samples.vtkhdf"))
        complaints = []
        for event in ("ErrorEvent", "WarningEvent"):
            reader.AddObserver(event, lambda caller, name: complaints.append(name))
        reader.UpdateInformation()
        key = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
        times = [reader.GetOutputInformation(0).Get(key, k) for k in range(reader.GetOutputInformation(0).Length(key))]
        self.assertEqual(times, [0.0, 0.1, 0.2])
        for k in (0, 2, 1):
            reader.UpdateTimeStep(times[k])
            collection = reader.GetOutputDataObject(0)
            for index, (name, files) in enumerate(FRAMES.items()):
                grid = collection.GetPartition(index, 0)
                self.assert_values(grid_values(grid), expected_values(self.folder, files[k]), (name, k))
                names = grid.GetFieldData().GetAbstractArray("block_names")
                self.assertEqual([names.GetValue(i) for i in range(names.GetNumberOfValues())], NAMES)
        self.assertEqual(complaints, [])


if __name__ == "__main__":
    if pathlib.Path(sys.argv[1]).is_dir():
        OneFile.folder = pathlib.Path(sys.argv[1])
        unittest.main(argv=sys.argv[:1])
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv[1], folder], check=True)
        OneFile.folder = pathlib.Path(folder)
        unittest.main(argv=sys.argv[:1])
