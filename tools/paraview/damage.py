"""Shows the damage of a result folder in ParaView: pvpython tools/paraview/damage.py results/brazilian-disk

Opens fields.pvd (and bonds.pvd if it is there), warps by the displacement times a factor, colours by damage from 0 to 1, draws the
broken bonds over it and writes the time above. Saves a picture of the last output, and if asked for an animation over all outputs and
a state (.pvsm) to go on with in ParaView. Without a display: xvfb-run -a pvpython ..., or pvpython --force-offscreen-rendering
... where ParaView was built for that.
"""

import argparse
import sys
from pathlib import Path

from paraview import simple
from paraview import servermanager

# Cividis is made for all kinds of colour vision; in grey it goes from dark to light as well.
COLOURS = "Cividis"


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, metavar="RESULT_FOLDER")
    parser.add_argument("--factor", type=float, help="times the displacement [default: such that it is 5 %% of the body]")
    parser.add_argument("--output", type=int, help="number of the output, from 0 [default: the last]")
    parser.add_argument("--screenshot", type=Path, metavar="FILE.png", help="[default: damage.png in the folder]")
    parser.add_argument("--animation", type=Path, metavar="FILE.png", help="one picture an output: FILE.0000.png and so on")
    parser.add_argument("--state", type=Path, metavar="FILE.pvsm")
    parser.add_argument("--size", type=int, nargs=2, default=(1200, 1000), metavar=("WIDTH", "HEIGHT"))
    arguments = parser.parse_args()
    if not (arguments.folder / "fields.pvd").is_file():
        parser.error(f"{arguments.folder} has no fields.pvd: it is no result folder of a run with loads")
    return arguments


def open_series(path, name):
    reader = simple.PVDReader(registrationName=name, FileName=str(path.resolve()))
    reader.UpdatePipelineInformation()
    return reader


def array_range(source, name, time):
    """Range of the size of an array, on points or cells."""
    source.UpdatePipeline(time)
    information = source.GetDataInformation()
    for data in (information.GetPointDataInformation(), information.GetCellDataInformation()):
        array = data.GetArrayInformation(name)
        if array is not None:
            return array.GetComponentRange(-1 if array.GetNumberOfComponents() > 1 else 0)
    raise SystemExit(f"there is no {name} in the fields")


def default_factor(fields, times):
    largest = max(array_range(fields, "displacement", time)[1] for time in times)
    x0, x1, y0, y1, _, _ = fields.GetDataInformation().GetBounds()
    size = max(x1 - x0, y1 - y0)
    if largest == 0.0:
        return 1.0
    factor = 0.05 * size / largest
    return float(f"{factor:.1g}")


def show_damage(fields, view, factor):
    warped = simple.WarpByVector(registrationName="deformed", Input=fields)
    # Corners of lattices move as their cells do: the displacement is on the points of all bodies.
    warped.Vectors = ["POINTS", "displacement"]
    warped.ScaleFactor = factor
    display = simple.Show(warped, view)
    display.Representation = "Surface"
    on_points = "damage" in [array.GetName() for array in fields.PointData]
    simple.ColorBy(display, ("POINTS" if on_points else "CELLS", "damage"))
    table = simple.GetColorTransferFunction("damage")
    table.ApplyPreset(COLOURS, True)
    table.RescaleTransferFunction(0.0, 1.0)
    # A fixed scale, whatever an output holds.
    table.AutomaticRescaleRangeMode = "Never"
    display.SetScalarBarVisibility(view, True)
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = "damage", ""
    bar.TitleColor = bar.LabelColor = (0.0, 0.0, 0.0)
    return warped


def show_broken(bonds, view, factor):
    """Bonds that are broken, as lines between their ends where these are now."""
    broken = simple.Threshold(registrationName="broken bonds", Input=bonds)
    broken.Scalars = ["CELLS", "intact"]
    broken.LowerThreshold = broken.UpperThreshold = 0.0
    broken.ThresholdMethod = "Between"
    warped = simple.WarpByVector(registrationName="broken bonds, deformed", Input=broken)
    warped.Vectors = ["POINTS", "displacement"]
    warped.ScaleFactor = factor
    display = simple.Show(warped, view)
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = (0.84, 0.37, 0.0)
    # The damage below shall be seen.
    display.LineWidth, display.Opacity = 1.0, 0.3


def show_time(fields, view):
    """The time of the collection: the number of the load step or event, in a motion the time in s."""
    title = simple.AnnotateTimeFilter(registrationName="time", Input=fields)
    # The way of writing the format changed with ParaView 5.11.
    version = servermanager.vtkSMProxyManager
    is_new = (version.GetVersionMajor(), version.GetVersionMinor()) >= (5, 11)
    title.Format = "time {time:.4g}" if is_new else "time %.4g"
    display = simple.Show(title, view)
    display.WindowLocation = "Upper Center"
    display.Color = (0.0, 0.0, 0.0)


def main():
    arguments = parse()
    fields = open_series(arguments.folder / "fields.pvd", "fields.pvd")
    times = list(fields.TimestepValues) or [0.0]
    output = len(times) - 1 if arguments.output is None else arguments.output
    if not 0 <= output < len(times):
        raise SystemExit(f"there is no output {output}: there are {len(times)}, from 0")
    factor = default_factor(fields, times) if arguments.factor is None else arguments.factor
    fields.UpdatePipeline(times[output])

    view = simple.CreateRenderView()
    view.ViewSize = list(arguments.size)
    view.UseColorPaletteForBackground = 0
    view.Background = (1.0, 1.0, 1.0)
    view.OrientationAxesVisibility = 0
    view.InteractionMode = "2D"
    show_damage(fields, view, factor)
    if (arguments.folder / "bonds.pvd").is_file():
        show_broken(open_series(arguments.folder / "bonds.pvd", "bonds.pvd"), view, factor)
    show_time(fields, view)

    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    view.ViewTime = scene.AnimationTime = times[output]
    simple.Render(view)
    view.ResetCamera(True)
    picture = arguments.screenshot or arguments.folder / "damage.png"
    simple.SaveScreenshot(str(picture), view, ImageResolution=list(arguments.size))
    print(f"{picture}: output at time {times[output]:g}, displacement times {factor:g}")
    if arguments.animation is not None:
        simple.SaveAnimation(str(arguments.animation), view, ImageResolution=list(arguments.size))
        print(f"{arguments.animation}: {len(times)} outputs")
    if arguments.state is not None:
        simple.SaveState(str(arguments.state))
        print(f"{arguments.state}: open it by File, Load State")
    # A view that is still there when ParaView ends makes some graphics drivers fail.
    simple.Delete(view)


if __name__ == "__main__":
    sys.exit(main())
