"""The arm as a line drawing: skeleton, joints, frames and dimensions, free of any format."""
