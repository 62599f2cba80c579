"""The templates of the pages."""

from __future__ import annotations

from functools import lru_cache
from importlib import resources

from jinja2 import BaseLoader, Environment, StrictUndefined, TemplateNotFound


class _Packaged(BaseLoader):
    """Templates from the package's data, also where the package is not a folder of files."""

    def get_source(self, environment: Environment, template: str) -> tuple[str, None, None]:
        try:
            return text(template), None, None
        except FileNotFoundError:
            raise TemplateNotFound(template) from None


def text(name: str) -> str:
    """The content of a file beside the templates."""
    return resources.files("ptproof.report").joinpath("templates", name).read_text(encoding="utf-8")


@lru_cache(maxsize=2)
def environment(*, escape: bool) -> Environment:
    """The environment of the templates; with ``escape`` everything is escaped for HTML and SVG."""
    return Environment(
        loader=_Packaged(), autoescape=escape, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
        keep_trailing_newline=True,
    )  # fmt: skip
