//! References as BibTeX: the program, and the papers behind what a case uses.

use std::fmt::Write;

/// The papers and books that the code cites, as tables of keys and sources.
const REFERENCES: &str = include_str!("../references.md");

/// A paper or a book.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reference {
    /// Key by which code and pages cite it, `Silling 2000`.
    pub key: &'static str,
    /// Authors, with commas between them.
    pub authors: &'static str,
    /// Title.
    pub title: &'static str,
    /// Journal with volume, year and pages, or publisher and year.
    pub place: &'static str,
    /// Digital object identifier, if one is known.
    pub doi: Option<&'static str>,
}

/// All references, in the order of the page.
pub fn references() -> Vec<Reference> {
    REFERENCES.lines().filter_map(Reference::from_row).collect()
}

/// References that texts such as `MPPD eqs 7, 21; OMPPD eqs 54 to 57` cite, in the order of the texts.
pub fn cited_references(sources: &[&str]) -> Vec<Reference> {
    let all = references();
    let mut found: Vec<Reference> = Vec::new();
    for part in sources.iter().flat_map(|source| source.split(';')) {
        let part = part.trim();
        let is_key = |it: &&Reference| {
            let rest = part.strip_prefix(it.key);
            rest.is_some_and(|rest| !rest.starts_with(|next: char| next.is_alphanumeric()))
        };
        // `Silling` would begin `Silling and Askari 2005` too: the longest key is meant.
        let reference = all.iter().filter(is_key).max_by_key(|it| it.key.len());
        found.extend(reference.filter(|it| !found.contains(it)).cloned());
    }
    found
}

impl Reference {
    /// The reference of a row of the page, `| key | authors: *title*, place. [doi:...](...) |`.
    fn from_row(row: &'static str) -> Option<Self> {
        let (key, source) = row
            .strip_prefix("| ")?
            .strip_suffix(" |")?
            .split_once(" | ")?;
        let (authors, rest) = source.split_once(": *")?;
        let (title, rest) = rest.split_once('*')?;
        let doi = rest
            .split_once("[doi:")
            .and_then(|(_, it)| it.split_once("](https"));
        let place = rest.split(". [doi:").next().unwrap_or(rest);
        let place = place.split(". No DOI").next().unwrap_or(place);
        Some(Self {
            key,
            authors,
            title,
            place: place.trim_matches([',', '.', ' ']),
            doi: doi.map(|it| it.0),
        })
    }

    /// The entry of a bibliography.
    pub fn bibtex(&self) -> String {
        let word: String = self
            .key
            .chars()
            .filter(char::is_ascii_alphanumeric)
            .collect();
        let authors = self
            .authors
            .trim_end_matches(" (eds)")
            .replace(", ", " and ");
        let mut fields = vec![
            ("author", authors),
            ("title", format!("{{{}}}", self.title)),
        ];
        let kind = match self.article() {
            Some([journal, volume]) => {
                fields.extend([("journal", journal), ("volume", volume)]);
                fields.extend(self.pages().map(|it| ("pages", it)));
                "article"
            }
            None => {
                fields.push(("howpublished", self.place.to_owned()));
                "misc"
            }
        };
        fields.extend(self.year().map(|it| ("year", it.to_owned())));
        fields.extend(self.doi.map(|it| ("doi", it.to_owned())));
        entry(kind, &word, &fields)
    }

    /// The year: the last number of four digits from 1800 to 2099 that is no page number.
    fn year(&self) -> Option<&'static str> {
        let is_year = |it: &&str| {
            it.len() == 4 && (it.starts_with("18") || it.starts_with("19") || it.starts_with("20"))
        };
        let whole = |it: &&str| it.chars().all(|it| it.is_ascii_digit());
        let words = self.place.split([' ', ',', '(', ')']);
        words.filter(is_year).rfind(whole)
    }

    /// Journal and volume of `Journal 48, 2000, 175-209` and of `Journal 48 (2000), 175-209`.
    fn article(&self) -> Option<[String; 2]> {
        let year = self.year()?;
        let head = self
            .place
            .split(year)
            .next()?
            .trim_end_matches([' ', ',', '(']);
        let (journal, volume) = head.rsplit_once(' ')?;
        let is_volume = volume.starts_with(|it: char| it.is_ascii_digit());
        is_volume.then(|| [journal, volume].map(|it| it.trim_matches(',').to_owned()))
    }

    /// Pages `175-209`, as BibTeX writes them, or the number of the article.
    fn pages(&self) -> Option<String> {
        let last = self.place.rsplit([' ', ',']).next()?;
        let is_number = last.starts_with(|it: char| it.is_ascii_digit());
        (is_number && Some(last) != self.year()).then(|| last.replace('-', "--"))
    }
}

/// The entry of this program.
pub fn program() -> String {
    let fields = [
        ("author", format!("{{{}}}", env!("CARGO_PKG_AUTHORS"))),
        (
            "title",
            "{Ligament: peridynamics as a finite-element-style toolchain}".to_owned(),
        ),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("url", env!("CARGO_PKG_REPOSITORY").to_owned()),
    ];
    entry("software", "Ligament", &fields)
}

fn entry(kind: &str, key: &str, fields: &[(&str, String)]) -> String {
    let mut text = format!("@{kind}{{{key},\n");
    for (name, value) in fields {
        // TeX reads `&` as the end of a column, and Markdown sets text between asterisks in italics.
        let value = value.replace('&', "\\&").replace('*', "");
        // Writing to a text does not fail.
        let _ = writeln!(text, "  {name} = {{{value}}},");
    }
    text + "}\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_reference_of_the_page_is_an_entry() {
        let rows = REFERENCES.lines().filter(|it| it.starts_with("| "));
        let rows: Vec<&str> = rows.filter(|it| *it != "| key | source |").collect();
        let all = references();
        assert!(all.len() > 70);
        let missing: Vec<&&str> = (rows.iter())
            .filter(|row| {
                !all.iter()
                    .any(|it| row.starts_with(&format!("| {} |", it.key)))
            })
            .collect();
        assert!(missing.is_empty(), "{missing:#?}");
        for reference in all {
            let text = reference.bibtex();
            assert_eq!(
                text.matches('{').count(),
                text.matches('}').count(),
                "{text}"
            );
        }
    }

    #[test]
    fn texts_of_sources_name_references() {
        let keys = |source| -> Vec<&str> {
            cited_references(&[source])
                .iter()
                .map(|it| it.key)
                .collect()
        };
        assert_eq!(
            keys("MPPD eqs 7, 21; OMPPD eqs 54 to 57"),
            ["MPPD", "OMPPD"]
        );
        assert_eq!(keys("Silling and Askari 2005"), ["Silling and Askari 2005"]);
        let [article] = &cited_references(&["Silling 2000"])[..] else {
            panic!("one reference");
        };
        let text = article.bibtex();
        for part in [
            "@article{Silling2000,",
            "author = {S. A. Silling}",
            "journal = {Journal of the Mechanics and Physics of Solids}",
            "volume = {48}",
            "pages = {175--209}",
            "year = {2000}",
            "doi = {10.1016/S0022-5096(99)00029-0}",
        ] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }

    #[test]
    fn whatever_a_law_or_a_criterion_cites_is_on_the_page() {
        let laws = ligament_model::law::LAWS.iter().map(|it| it.source);
        let kinds = ligament_model::failure::KINDS.iter().map(|it| it.source);
        let after = ligament_model::failure::softening::LAWS
            .iter()
            .map(|it| it.source);
        for source in laws.chain(kinds).chain(after).filter(|it| !it.is_empty()) {
            let parts = source.split(';').count();
            assert_eq!(cited_references(&[source]).len(), parts, "{source}");
        }
    }
}
