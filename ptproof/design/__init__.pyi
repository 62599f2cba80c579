from .answer import Design as Design
from .answer import Trial as Trial
from .chart import feasible_map as feasible_map
from .limits import Limits as Limits
from .search import design as design
