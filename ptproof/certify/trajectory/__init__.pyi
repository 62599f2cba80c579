from .door import enclose as enclose
from .enclosure import Enclosure as Enclosure
from .march import Switch as Switch
