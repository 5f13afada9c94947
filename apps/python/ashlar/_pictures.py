"""Pages and pictures of results, as by `ashlar view` and `ashlar picture`."""

import html
import os
import pathlib
import tempfile

from . import _core  # type: ignore[attr-defined]


def _command(arguments):
    status, told = _core.command(arguments)
    if status == 2:
        raise ValueError(told)
    if status != 0:
        raise RuntimeError(told)


def _arguments(options):
    """Options of `ashlar picture` from keywords: view is --from, force_chain=True a flag, lists are joined by commas."""
    arguments = []
    for name, value in options.items():
        option = "--" + ("from" if name in ("view", "from_") else name.replace("_", "-"))
        if value is None or value is False:
            continue
        if isinstance(value, (list, tuple)):
            value = ",".join(str(part) for part in value)
        arguments.append(option if value is True else f"{option}={value}")
    return arguments


def picture(folder, path=None, **options):
    """Draws a frame of a result folder, the last one unless `frame` says otherwise.

    options: those of `ashlar picture`: size="1200x800", view="front" (its --from), color="von_mises", joints="opening",
    force_chain=True, scale=100, relative_to="base", ... Returns the PNG as bytes, or the path it is written to.
    Raises ValueError for a wrong option or folder, RuntimeError without a browser (chromium).
    """
    with tempfile.TemporaryDirectory() as scratch:
        target = pathlib.Path(scratch) / "picture.png" if path is None else pathlib.Path(path)
        _command(["picture", str(folder), f"--out={target}", *_arguments(options)])
        return target.read_bytes() if path is None else target


class Page:
    """The page of results, one text of HTML. A notebook shows it as an output."""

    def __init__(self, text, height=640):
        self.html, self.height = text, height

    def write(self, path):
        """Writes the page as a file for a browser. Returns its path."""
        path = pathlib.Path(path)
        path.write_text(self.html, encoding="utf-8")
        return path

    def _repr_html_(self):
        return (f'<iframe srcdoc="{html.escape(self.html)}" style="width: 100%; height: {self.height}px; border: none">'
                "</iframe>")

    def __repr__(self):
        return f"<ashlar.Page of {len(self.html) / 1e6:.1f} MB; write(path) saves it for a browser>"


def page(folder, height=640, relative_to=None):
    """The page of a result folder. height: pixels in a notebook; relative_to: block that displacements are relative to."""
    with tempfile.TemporaryDirectory() as scratch:
        target = os.path.join(scratch, "view.html")
        _command(["view", str(folder), f"--out={target}", *_arguments({"relative_to": relative_to})])
        return Page(pathlib.Path(target).read_text(encoding="utf-8"), height)
