//! Message about interfaces that no bond crosses.

use ligament_analysis::Message;
use ligament_model::ConstantFields;
use ligament_model::subdomain::Subdomain;

/// A message for each interface that no bond crosses, because the materials do not touch.
pub(crate) fn of_interfaces(fixed: &ConstantFields, subdomain: &Subdomain) -> Vec<Message> {
    let interfaces = fixed.interfaces.iter();
    let idle = interfaces
        .filter(|(_, crosses)| subdomain.count(crosses.iter().filter(|it| **it).count()) == 0);
    let message = |(name, _): &(String, Vec<bool>)| {
        let text = format!("no bond crosses the interface {name}: its materials do not touch");
        Message::new("interface-without-bonds", text)
            .with_advice("name two materials whose cells have nodes in common")
    };
    idle.map(message).collect()
}
