"""Live: a region that is made fair again after every change around it."""
