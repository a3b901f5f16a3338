"""Cases that come with the package, each with its mesh: small bodies of rock, concrete and glass that crack.

>>> import ligament
>>> ligament.examples.names()
['brazilian-disk', 'l-panel', 'notched-beam', 'split-block']
>>> result = ligament.run(ligament.examples.path("l-panel"), fracture__steps=3, progress=False)

The pages of the cases in the repository say what they are and what to expect.
"""

from difflib import get_close_matches
from pathlib import Path

from ligament._errors import LigamentError

__all__ = ["names", "path"]

_CASES = Path(__file__).resolve().parent / "cases"


def names() -> list[str]:
    """The names of the examples."""
    return sorted(folder.name for folder in _CASES.iterdir())


def path(name: str) -> Path:
    """The case file of an example, for `ligament.run` and for the command line; it names its mesh beside it."""
    known = names()
    if name not in known:
        nearest = get_close_matches(name, known, n=1, cutoff=0.0)[0]
        hint = f"did you mean {nearest!r}? There are {', '.join(known)}"
        raise LigamentError(f"there is no example {name!r}; {hint}", hint=hint)
    return _CASES / name / "case.toml"
