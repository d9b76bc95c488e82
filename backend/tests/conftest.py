"""What every test shares: how hypothesis searches."""

import os

from hypothesis import HealthCheck, settings

# The same examples on every run: a red test stays red until it is mended. SCANBENCH_EXPLORE=1 goes looking for new ones.
settings.register_profile(
    "steady", derandomize=True, deadline=None, database=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("explore", deadline=None, max_examples=1000, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("explore" if os.environ.get("SCANBENCH_EXPLORE") else "steady")
