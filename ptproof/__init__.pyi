from . import proof as proof
from . import testing as testing
from .averaging import average as average
from .averaging import split_dithers as split_dithers
from .certify import certify_field as certify_field
from .errors import InputError as InputError
from .gains import GainData as GainData
from .gains import gains as gains
from .gains import tight_bound as tight_bound
from .problem import Problem as Problem
from .problem import example as example
from .problem import load as load
from .problem.field import FieldBounds as FieldBounds
from .proof.run import verify as verify
from .simulation import Ensemble as Ensemble
from .simulation import Outcome as Outcome
from .simulation import Trajectory as Trajectory
from .simulation import ensemble as ensemble
from .simulation import linearize_at_source as linearize_at_source
from .simulation import simulate as simulate
from .simulation import to_control as to_control
from .system import DitherSystem as DitherSystem
from .system import System as System
from .transforms.time import contract as contract
from .transforms.time import dilate as dilate

__version__: str
