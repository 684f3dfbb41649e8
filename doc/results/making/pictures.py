# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves and sheets of packs, drawn with matplotlib into small PNG files."""
import matplotlib
import numpy
from PIL import Image

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402

# Blue and vermilion of Okabe and Ito: told apart by everybody, and by line style.
STYLE = {"on": ("#0072B2", "o-"), "off": ("#D55E00", "s--")}


def save(figure, name):
    """With a palette of 64 colours, a fifth of the bytes."""
    figure.savefig(name, dpi=100, metadata={"Software": None})
    pyplot.close(figure)
    with Image.open(name) as full:
        small = full.convert("RGB").quantize(64)
    small.save(name, optimize=True)


def curves(name, panels, x_label, log=False):
    """panels: (title of the y axis, {(label, rotations): [(x, mean, error), ...]}), side by
    side."""
    figure, axes = pyplot.subplots(1, len(panels), figsize=(4.2 * len(panels), 3.2),
                                   layout="constrained", squeeze=False)
    for axis, (y_label, lines) in zip(axes[0], panels):
        for (label, rotations), points in lines.items():
            colour, style = STYLE[rotations]
            x, y, error = (numpy.array(v) for v in zip(*points))
            axis.errorbar(x, y, numpy.nan_to_num(error), fmt=style, color=colour, label=label,
                          capsize=2, markersize=4, linewidth=1)
        axis.set_xlabel(x_label)
        axis.set_ylabel(y_label)
        if log:
            axis.set_xscale("log")
        axis.grid(alpha=.3)
        axis.legend(fontsize=8)
    save(figure, name)


def sheet_of_discs(name, packs, height):
    """packs: (title, x, r, |psi_6|) in rows of two; discs coloured by that."""
    rows = (len(packs) + 1) // 2
    figure, axes = pyplot.subplots(rows, 2, figsize=(8, 2.2 * rows), layout="constrained",
                                   squeeze=False)
    drawn = None
    for axis, (title, x, r, order) in zip(axes.flat, packs):
        drawn = EllipseCollection(2 * r, 2 * r, numpy.zeros(len(r)), units="xy", offsets=x,
                                  transOffset=axis.transData, array=order,
                                  cmap="viridis", edgecolors="none")
        drawn.set_clim(0, 1)
        axis.add_collection(drawn)
        axis.axhline(height, color="black", linewidth=.6)
        axis.set(xlim=(0, 1), ylim=(0, 1.08 * height), aspect="equal", xticks=[], yticks=[])
        axis.set_title(title, fontsize=8)
    for axis in axes.flat[len(packs):]:
        axis.remove()
    if drawn is not None:
        figure.colorbar(drawn, ax=axes, shrink=.5, label=r"$|\psi_6|$")
    save(figure, name)


def sheet_of_images(name, images, columns=4):
    """images: (title, PNG file), in rows."""
    rows = (len(images) + columns - 1) // columns
    figure, axes = pyplot.subplots(rows, columns, figsize=(2.3 * columns, 2.1 * rows),
                                   layout="constrained", squeeze=False)
    for axis in axes.flat:
        axis.axis("off")
    for axis, (title, file) in zip(axes.flat, images):
        axis.imshow(cropped(pyplot.imread(file)), interpolation="antialiased")
        axis.set_title(title, fontsize=8)
    save(figure, name)


def cropped(image):
    """Without its margin, which has the colour of the first pixel."""
    used = (numpy.abs(image - image[0, 0]) > .02).any(axis=2)
    if not used.any():
        return image
    rows, columns = numpy.flatnonzero(used.any(axis=1)), numpy.flatnonzero(used.any(axis=0))
    return image[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1]
