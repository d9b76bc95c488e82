"""The database: projects, files, accepted builds, instances, error history, log."""
