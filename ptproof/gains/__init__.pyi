from .answer import gains as gains
from .data import GainData as GainData
from .problem import study as study
from .tight import tight_bound as tight_bound
