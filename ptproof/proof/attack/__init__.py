"""The attacker: before a statement counts as proved, it is tried at exact points of its declared domain.

It shares no evaluation with the engines. What it hits is wrong, whatever an engine said; that it hits nothing proves
nothing.
"""

from ptproof.proof.attack.attacker import Attack as Attack
from ptproof.proof.attack.attacker import Hit as Hit
from ptproof.proof.attack.attacker import attack as attack
from ptproof.proof.attack.attacker import points_of as points_of
from ptproof.proof.attack.worth import Place as Place
from ptproof.proof.attack.wrong import WrongPromise as WrongPromise
from ptproof.proof.attack.wrong import insist as insist
