"""What tests share: small FOONs, brute force, the command line."""
