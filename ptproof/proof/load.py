"""Reading a folder or file of derivations: its modules, its claims and definitions, in the order of the text."""

from __future__ import annotations

import contextlib
import hashlib
import importlib.machinery
import importlib.util
import sys
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType

from ptproof.errors import InputError
from ptproof.proof.claim import Claim, Definition
from ptproof.proof.gap import Gap
from ptproof.proof.shipped import shipped as shipped
from ptproof.reading.outcomes import in_words

_YOUNG = 2.0  # seconds


class NoClaims(InputError):
    """The files hold no claim."""


@dataclass(frozen=True)
class Derivation:
    """The claims and definitions of one or more folders, sections in the order of their files.

    ``homes`` says for each claim in which file it stands; ``gaps`` are formulas of a paper that nothing states yet.

    Raises
    ------
    InputError
        If two claims or definitions share an id.
    """

    claims: tuple[Claim, ...]
    definitions: tuple[Definition, ...]
    paths: tuple[str, ...]
    packages: tuple[ModuleType, ...] = ()
    homes: Mapping[str, str] = field(default_factory=dict)
    gaps: tuple[Gap, ...] = ()

    def __post_init__(self) -> None:
        seen: dict[str, Claim | Definition] = {}
        for item in self.items:
            if item.id in seen:
                raise twice(seen[item.id], item)
            seen[item.id] = item

    @property
    def items(self) -> tuple[Claim | Definition, ...]:
        """The claims, then the definitions."""
        return (*self.claims, *self.definitions)

    def select(self, text: str) -> tuple[Claim, ...]:
        """The claims whose id, title, section or labels contain ``text``, and all that they use."""
        if not text:
            return self.claims
        wanted = {item.id for item in with_ancestors(item for item in self.claims if item.contains(text))}
        return tuple(item for item in self.claims if item.id in wanted)


def twice(first: Claim | Definition, other: Claim | Definition, where: str = "") -> InputError:
    """The error that two claims or definitions share an id."""
    return InputError(f"{where}the id {other.id!r} stands twice: {first.title!r} and {other.title!r}")


def with_ancestors(claims: Iterable[Claim]) -> tuple[Claim, ...]:
    """The claims and all that they use, what is used first, each once; two with one id are an error."""
    found: dict[str, Claim] = {}

    def take(item: Claim) -> None:
        if item.id not in found:
            for used in item.uses:
                take(used)
        if found.setdefault(item.id, item) is not item:
            raise twice(found[item.id], item)

    for item in claims:
        take(item)
    return tuple(found.values())


def load(paths: str | Path | Sequence[str | Path] = (), only: Collection[Path] | None = None) -> Derivation:
    """Import every module below ``paths`` (the shipped derivations where left out) and collect what they hold.

    A folder that holds Python files is one derivation and is imported as a package, so its modules may say
    ``from .notation import …``. A folder of such folders holds several. With ``only`` these of its files are imported,
    and what they import.

    Raises
    ------
    InputError
        If a path does not exist, holds no claim, definition or gap (:class:`NoClaims`), or a module cannot be imported:
        with file, line and reason.
    """
    several = [paths] if isinstance(paths, str | Path) else paths
    chosen = [Path(path) for path in several] or [shipped()]
    names = {file: _module_name(file, chosen) for file in files_of(chosen)}
    _distrust_compiled({file.parent for file in names})
    modules = [_module(file, name) for file, name in names.items() if only is None or file in only]
    if only is not None:  # what they import holds claims as well
        modules = [sys.modules[name] for name in names.values() if name in sys.modules]
    found: dict[str, Claim | Definition] = {}
    homes: dict[str, str] = {}
    # A module's own items first: what it imports from another section keeps the place that it has there.
    for own in (True, False):
        for module in modules:
            for item in _items(module):
                if (item.section == getattr(module, "SECTION", "")) is own:
                    # An item is kept once, however many modules import it.
                    if (first := found.setdefault(item.id, item)) is not item:
                        raise twice(first, item, f"{module.__file__}: ")
                    homes.setdefault(item.id, str(module.__file__))
    claims = [item for item in found.values() if isinstance(item, Claim)]
    gaps = {id(value): value for module in modules for value in vars(module).values() if isinstance(value, Gap)}
    if not found and not gaps:
        raise NoClaims(f"{', '.join(map(str, chosen))}: no claims found")
    missing = {used.id: used for used in with_ancestors(claims) if used.id not in found}
    definitions = tuple(item for item in found.values() if isinstance(item, Definition))
    packages = dict.fromkeys(module.__name__.partition(".")[0] for module in modules)
    every = (*claims, *missing.values())
    modules = [sys.modules[name] for name in packages]
    return Derivation(every, definitions, tuple(map(str, chosen)), tuple(modules), homes, tuple(gaps.values()))


def files_named(paths: Sequence[Path], stem: str) -> tuple[str, ...]:
    """The files of this name below the paths that are modules beside others."""
    return tuple(str(file) for file in files_of(paths) if file.stem == stem and "." in _module_name(file, paths))


def modules_of(files: Iterable[str]) -> list[ModuleType]:
    """The modules of these files, imported with what they import and nothing else."""
    chosen = [Path(file) for file in files]
    _distrust_compiled({file.parent for file in chosen})
    return [_module(file) for file in chosen]


def _distrust_compiled(folders: Iterable[Path]) -> None:
    """Remove what Python has compiled of files that were young then.

    Python takes a compiled file for that of the present text if the text has the same size and the same second of
    change; what is decided has to be what is written.
    """
    for folder in folders:
        for file in folder.rglob("*.py"):
            with contextlib.suppress(OSError, NotImplementedError):
                compiled = Path(importlib.util.cache_from_source(str(file)))
                if compiled.stat().st_mtime < file.stat().st_mtime + _YOUNG:
                    compiled.unlink()


def homes_of(claims: Iterable[Claim]) -> dict[str, str]:
    """For each claim that stands in a module with a file, that file."""
    wanted = {id(item) for item in claims}
    modules = [module for module in list(sys.modules.values()) if isinstance(module, ModuleType)]
    files = {module: getattr(module, "__file__", None) for module in modules if module.__name__ != "__main__"}
    return {item.id: file for module, file in files.items() if file for item in _items(module) if id(item) in wanted}


def claims_in(files: Iterable[str]) -> dict[str, Claim]:
    """The claims that stand in these files, or are used there, by their ids; other files of their folders are left."""
    modules = map(_module, map(Path, files))
    own = (item for module in modules for item in _items(module) if isinstance(item, Claim))
    return {item.id: item for item in with_ancestors(own)}


def _items(module: ModuleType) -> Iterator[Claim | Definition]:
    for value in list(vars(module).values()):
        for item in value if isinstance(value, list | tuple) else (value,):
            if isinstance(item, Claim | Definition):
                yield item


def files_of(paths: Sequence[Path]) -> list[Path]:
    """The files of derivations that the paths name or hold, in the order in which they are imported.

    Raises
    ------
    InputError
        If a path does not exist, or holds none.
    """
    found: list[Path] = []
    for path in paths:
        if not path.exists():
            raise InputError(f"{path}: no such file or folder")
        found += _files(path.resolve())
    return found


def _files(path: Path) -> Iterable[Path]:
    if path.is_file():
        if path.suffix != ".py":
            raise InputError(f"{path}: not a Python file of derivations")
        return [path]
    files = sorted(
        file for file in path.glob("*.py") if file.name != "__init__.py" and not file.name.startswith("test_")
    )
    if files:
        return files
    folders = sorted(folder for folder in path.iterdir() if folder.is_dir() and any(folder.glob("*.py")))
    if not folders:
        raise InputError(f"{path}: no Python files of derivations")
    return (file for folder in folders for file in _files(folder))


def _module_name(file: Path, chosen: Sequence[Path] = ()) -> str:
    """The name of a file as a module of its folder; alone where the file itself is chosen and that is no package."""
    alone = not (file.parent / "__init__.py").exists() and any(path.resolve() == file for path in chosen)
    return _name(file) if alone else f"{_name(file.parent)}.{file.stem}"


def _name(path: Path) -> str:
    # The path is part of the name, so that two folders of the same name are two packages.
    return f"ptproof_derivation_{path.stem}_{hashlib.sha256(str(path).encode()).hexdigest()[:8]}"


def _module(file: Path, name: str = "") -> ModuleType:
    """The module of a file, as part of the package that its folder is, or alone under that name."""
    name = name or _module_name(file)
    if "." in name:
        _package(file.parent)
    return _import(name, file)


def _package(folder: Path) -> str:
    name, init = _name(folder), folder / "__init__.py"
    if init.exists():
        _import(name, init, [str(folder)])
    elif name not in sys.modules:
        spec = importlib.machinery.ModuleSpec(name, None, is_package=True)
        spec.submodule_search_locations = [str(folder)]
        sys.modules[name] = importlib.util.module_from_spec(spec)
    return name


def _import(name: str, file: Path, folders: list[str] | None = None) -> ModuleType:
    """The module of that name, read from ``file`` where it is new; a package looks for its modules in ``folders``."""
    if name in sys.modules:
        return sys.modules[name]
    spec = importlib.util.spec_from_file_location(name, file, submodule_search_locations=folders)
    if spec is None or spec.loader is None:
        raise InputError(f"{file}: cannot be imported")
    sys.modules[name] = module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except BaseException as error:
        sys.modules.pop(name, None)
        if isinstance(error, InputError):
            raise InputError(f"{file}: {error}") from error
        if isinstance(error, KeyboardInterrupt):  # it may be a person's
            raise
        what = f"{type(error).__name__}: {error}" if isinstance(error, Exception) else f"the module {in_words(error)}"
        raise InputError(f"{_where(error, file)}: {what}") from error
    return module


def _where(error: BaseException, file: Path) -> str:
    """The place in the derivation at which the import failed: the last line that is the user's own."""
    if isinstance(error, SyntaxError) and error.filename:
        return f"{error.filename}, line {error.lineno}"
    place, trace = str(file), error.__traceback__
    while trace is not None:
        name = trace.tb_frame.f_code.co_filename
        if Path(name).parent == file.parent:
            place = f"{name}, line {trace.tb_lineno}"
        trace = trace.tb_next
    return place
