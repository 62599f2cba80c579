from .certificate import LoopCertificate as LoopCertificate
from .certify import certify_loop as certify_loop
