"""Damping of the contacts: restitution, best-fitting β, its law."""

# β of the study's simulations of the Sorrentino wall [s]; those above 0.001 s it calls overdamped
FREE_ROCKING_LOW_S = (0.000125, 0.00025, 0.0005, 0.001)
FREE_ROCKING_HIGH_S = (0.002, 0.004, 0.0058)
