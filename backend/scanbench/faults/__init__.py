"""The error simulator: raises and recovers every error that the model knows."""
