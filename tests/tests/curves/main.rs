//! Curves, cams and gears: contacts of every kind, from formulas and from data.

mod cams;
mod cams_from_data;
mod degenerate_contacts;
mod gearing;
mod iterations;
mod special_cases;
