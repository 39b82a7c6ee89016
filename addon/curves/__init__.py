"""Fair From Curves: a surface over edges that have no faces."""
