"""Fair Denoise: faces without their roughness."""
