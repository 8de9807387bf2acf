# SPDX-License-Identifier: BSD-3-Clause
# The compiled module that was chosen at import. Its classes are described where they are public.
from typing import Any

def __getattr__(name: str) -> Any: ...
