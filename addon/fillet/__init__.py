"""Fair Fillet: rounded seams, from selected edges to new faces, operator, script and preview."""
