"""What the C target is made of: function bodies, the kernel of sines and cosines, batches."""
