"""The sentence in which something stands."""

from __future__ import annotations

import re

_FAR = 600
# A sentence ends before a capital letter; the dot of an abbreviation does not end it.
_END = re.compile(
    r"(?<!Def)(?<!Eq)(?<!Eqs)(?<!Thm)(?<!Prop)(?<!Fig)(?<!Sec)(?<!Lem)(?<!Cor)(?<!Ref)(?<!resp)(?<!cf)(?<!e\.g)(?<!i\.e)"
    r"(?<!\.t)\.\s+(?=[A-Z])|\n[ \t]*\n|\\item(?![a-zA-Z])|\\(?:sub)*section(?![a-zA-Z])"
)


def sentence(text: str, start: int, end: int) -> tuple[str, str]:
    """What stands in the sentence of ``text[start:end]`` before it and behind it: rather more than too little."""
    before = text[max(0, start - _FAR) : start]
    behind = text[end : end + _FAR]
    last = max((match.end() for match in _END.finditer(before)), default=0)
    close = _END.search(behind)
    return before[last:], behind[: close.start()] if close else behind
