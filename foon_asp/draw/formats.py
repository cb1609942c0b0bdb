"""The formats of pictures, and pictures as Python has them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from foon_asp.draw.colours import DARK, LIGHT
from foon_asp.draw.dot import dot_text, program
from foon_asp.draw.layout import graphviz
from foon_asp.draw.mermaid import mermaid_text
from foon_asp.draw.picture import Picture
from foon_asp.draw.svg import svg_text
from foon_asp.errors import QueryError
from foon_asp.io import atomic
from foon_asp.values import said


class Format(StrEnum):
    """A format that pictures are written in."""

    SVG = "svg"
    PNG = "png"
    PDF = "pdf"
    DOT = "dot"
    MERMAID = "mermaid"

    @property
    def binary(self) -> bool:
        """Whether it is bytes, not text."""
        return self in (Format.PNG, Format.PDF)


SUFFIXES = {
    ".svg": Format.SVG,
    ".png": Format.PNG,
    ".pdf": Format.PDF,
    ".dot": Format.DOT,
    ".gv": Format.DOT,
    ".mmd": Format.MERMAID,
    ".mermaid": Format.MERMAID,
}


def format_of(path: Path) -> Format:
    """Return the format that the suffix of a file names; raise `QueryError` if it names none."""
    found = SUFFIXES.get(path.suffix.lower())
    if found is None:
        raise QueryError(f"{path}: no picture has this suffix; there are {', '.join(SUFFIXES)}")
    return found


@dataclass(frozen=True, slots=True, repr=False)
class Drawing:
    """A picture that can be written in every format; notebooks show it.

    `dark` says whether it is on dark paper; None: an SVG follows the reader, all other formats are light.
    Graphviz finds places when a format needs them: then `QueryError` is raised if it is not there.
    """

    picture: Picture
    dark: bool | None = None

    def __repr__(self) -> str:
        return f"<Drawing: {self.picture.title or self.picture.summary}>"

    def to_svg(self) -> str:
        """Return it as SVG; every node and arrow has a title that says all of it."""
        return svg_text(self.picture, dark=self.dark)

    def to_png(self) -> bytes:
        """Return it as PNG, which takes a font on the machine."""
        return graphviz(self.to_dot(), "png", program(self.picture))

    def to_pdf(self) -> bytes:
        """Return it as PDF, which takes a font on the machine."""
        return graphviz(self.to_dot(), "pdf", program(self.picture))

    def to_dot(self) -> str:
        """Return it in the language of Graphviz, which is not needed for it."""
        return dot_text(self.picture, DARK if self.dark else LIGHT)

    def to_mermaid(self) -> str:
        """Return it as a flow chart of Mermaid; raise `QueryError` for a plot, which is none."""
        if self.picture.settled:
            raise QueryError(
                "a plot is no flow chart, and Mermaid draws nothing else here; take another format"
            )
        return mermaid_text(self.picture, DARK if self.dark else LIGHT)

    def written(self, form: Format) -> str | bytes:
        """Return it in a format: text, or bytes for PNG and PDF."""
        writers: dict[Format, Callable[[], str | bytes]] = {
            Format.SVG: self.to_svg,
            Format.PNG: self.to_png,
            Format.PDF: self.to_pdf,
            Format.DOT: self.to_dot,
            Format.MERMAID: self.to_mermaid,
        }
        return writers[form]()

    def save(self, path: str | Path) -> None:
        """Write it to a file, in the format that its suffix names; what is there is replaced.

        Raises `QueryError` for another suffix, and `InputError`.
        """
        if not isinstance(path, str | Path):
            raise QueryError(f"a file is a path, not {said(path)}")
        data = self.written(format_of(Path(path)))
        atomic.write_bytes(Path(path), data if isinstance(data, bytes) else data.encode())

    def _repr_svg_(self) -> str:
        return self.to_svg()
