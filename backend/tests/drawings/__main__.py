"""`python -m tests.drawings N [SEED]`: N random ladders, diagrams and charts in all from a seed on, on all cores; prints those that fail.

A fresh seed is taken when none is given.
"""

import secrets
import sys

from tests.drawings import SIZE, batch_failure
from tests.seeds import run

if __name__ == "__main__":
    numbers = [int(word) for word in sys.argv[1:]]
    batches = -(-(numbers[0] if numbers else 1000) // SIZE)
    seed = numbers[1] if len(numbers) > 1 else secrets.randbelow(10**9)
    sys.exit(1 if run(batch_failure, batches, seed, "drawings", SIZE) else 0)
