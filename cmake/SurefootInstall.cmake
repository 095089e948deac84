# Filled in by the install step: see docs/architecture.md.
