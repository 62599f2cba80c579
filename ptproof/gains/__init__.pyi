from .answer import Gains as Gains
from .answer import gains as gains
from .clipped import Horizon as Horizon
from .data import GainData as GainData
from .numbers import NotApplicable as NotApplicable
from .numbers import Quantity as Quantity
from .tight import tight_bound as tight_bound
