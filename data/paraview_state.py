"""Opens results.vtkhdf in ParaView (5.13 or later): blocks by displacement, joints by opening, forces of contacts.

paraview --script paraview_state.py            opens results.vtkhdf of the present folder
pvpython paraview_state.py FILE [PICTURE.png]  draws the last frame
"""
import os
import sys

from paraview.simple import (ColorBy, ExtractBlock, GetActiveViewOrCreate, GetAnimationScene, Glyph, Hide, OpenDataFile,
                             Render, RenameSource, ResetCamera, SaveScreenshot, Show, UpdatePipeline)

path = sys.argv[1] if len(sys.argv) > 1 else "results.vtkhdf"
results = OpenDataFile(os.path.abspath(path))
if results is None:
    sys.exit(f"{path} is no file that this ParaView reads: results.vtkhdf and ParaView 5.13 are needed")
last = results.TimestepValues[-1]
view = GetActiveViewOrCreate("RenderView")
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
view.ViewTime = last


def series(name):
    """One series of the file as a source of its own; None if the run has none."""
    part = ExtractBlock(Input=results, Assembly="Assembly", Selectors=["//" + name])
    UpdatePipeline(time=last, proxy=part)
    RenameSource(name, part)
    return part if part.GetDataInformation().GetNumberOfCells() else None


def shown(source, kind, field, component=None):
    display = Show(source, view)
    ColorBy(display, (kind, field, component) if component else (kind, field))
    display.RescaleTransferFunctionToDataRange(False, True)
    return display


blocks, joints, contacts = series("blocks"), series("joints"), series("contacts")
display = shown(blocks, "POINTS", "displacement", "Magnitude")
display.Representation = "Surface With Edges"
display.SetScalarBarVisibility(view, True)
if joints:
    shown(joints, "CELLS", "opening")
    Hide(joints, view)
if contacts:
    forces = Glyph(Input=contacts, GlyphType="Arrow", OrientationArray=["POINTS", "force"], ScaleArray=["POINTS", "force"])
    RenameSource("forces", forces)
    shown(forces, "POINTS", "force", "Magnitude")
    Hide(forces, view)
view.CameraFocalPoint, view.CameraPosition, view.CameraViewUp = [0, 0, 0], [1, -2, 1], [0, 0, 1]
ResetCamera(view)
Render(view)
if len(sys.argv) > 2:
    SaveScreenshot(sys.argv[2], view, ImageResolution=[1200, 800])
