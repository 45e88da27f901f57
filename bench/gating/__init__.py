# SPDX-License-Identifier: MIT
"""What bench/gate is made of: trees and pairs, counts, ratios, their judgment, reports and history."""
