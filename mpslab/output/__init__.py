"""What a run writes: its folder, tables, frames, checkpoint."""
