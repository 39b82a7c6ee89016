"""One run: read, solve, write, report; by operator, script or command line."""
