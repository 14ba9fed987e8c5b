"""What `orchestra plan` does besides showing a plan: choosing, comparing, explaining."""
