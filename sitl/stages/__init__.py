"""What a vehicle flies at one time: a path, a circle, a climb-out, a glide. A flight is stages one after another."""
