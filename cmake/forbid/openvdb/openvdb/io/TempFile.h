#error "This room does not know OpenVDB: only volume does."
