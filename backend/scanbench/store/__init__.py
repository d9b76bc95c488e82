"""The database: projects, files, accepted builds, instances, error history, sweeps, test records, log."""
