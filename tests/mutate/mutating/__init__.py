# SPDX-License-Identifier: MIT
"""What tests/mutate/run is made of: sites to change, trials of the changes, survivors and the report."""
