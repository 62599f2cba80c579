from .certificate import FieldCertificate as FieldCertificate
from .certificate import FieldWitness as FieldWitness
from .certificate import Range as Range
from .domain import Domain as Domain
from .loop import LoopCertificate as LoopCertificate
from .loop import certify_loop as certify_loop
from .search import certify_field as certify_field
