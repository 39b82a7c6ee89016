"""What a result is worth: what is measured, the verdict, the report and its panel."""
