namespace fluidtex {}
